"""A participant's session on the stage: one sentence, and answers by key, finger or the device's buttons.

Each trial is a run with a recording. Its stimuli change within the run, while the needle is outside the tissue and the
view is covered. Its answer is on the disk before the run of the next one begins.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import partial

import numpy as np
import numpy.typing as npt
from pydantic import BaseModel

from punctura import Phase, PuncturaError, Scene
from punctura._core import Fault, ServoState
from punctura.defects import explain
from punctura.errors import FREE_SPACE, sentence_of
from punctura.events import crossing
from punctura.perception.course import Trial, counted
from punctura.perception.protocol import Protocol
from punctura.perception.session import Session as Answers
from punctura.perception.session import agreed, recordings
from punctura.perception.stimulus import READY_S, Felt, Spoilt, faulted, felt_of
from punctura.perception.words import plain
from punctura.record import RecorderStatus
from punctura.studio.activity import Outcome
from punctura.studio.loaded import Loaded
from punctura.studio.session import Session
from punctura.studio.wire.messages import AnswerKey, SittingMessage
from punctura.ticks import ABSENT, COMMAND_SCENE, Ticks

GO = {"go_on": "Enter"}
UNMASKED = Spoilt("unmasked", "the browser did not play the masking noise: click its page once, or allow it sound")
ENDED = Spoilt("failed", "the ticks have ceased: check the connection of the device")
MEND = f"mend this (on a full disk, {FREE_SPACE})"
Then = Callable[[str], None]  # gets an answer


class PerceptionSitting:
    """One participant's session, or the rest of it, for the worker's thread. It is the activity of each of its runs."""

    what = "session"
    end_at: float | None = None
    noise_plays = False

    def __init__(
        self, studio: Session, protocol: Protocol, base: Loaded, participant: str, tell: Callable[[str], None]
    ) -> None:
        """base: the scene's file. tell: writes to the experimenter's terminal.

        The answers are beside the studio's recordings. Raises SessionError.
        """
        self._tell = tell
        self._studio, self._protocol, self._base, self._participant = studio, protocol, base, participant
        self._words, self._folder = protocol.file.words, studio.shelf.folder
        page = self._words.model_dump(include={"force_off", "sound", "gone"})
        self._shown = SittingMessage(
            question=0, sentence="", answers=[], typed="", covered=True, noise=protocol.file.noise, **page
        )
        self._then: Then = lambda answer: None
        self._read: dict[str, str] = {}  # each answer as the participant reads it
        self._remark = f"{self._words.unfelt} " * studio.bench.simulated  # before the next sentence
        self._held = 0  # buttons
        self._trial: Trial
        self._block: int | None = None  # of the trial before
        self._attempt = self._interval = 0  # at this trial, from 1; in this attempt, from 0
        self._over = True  # the interval: the needle may do what it wants
        self._through = math.inf  # depth behind the judged membrane, m
        self._whole = self._faded = 0.0  # ticks since the force came on, and since the last stimulus began to fade in
        self._last = -1  # tick
        self._touched = self._was_through = self._uncovered = self._unmasked = False
        self._answers: Answers | None = None
        if agreed(protocol, self._folder, participant) or not protocol.file.consent:
            self._open()

    def start(self) -> None:
        self._idle()
        if self._answers is None:
            answers = self._words.model_dump(include={"yes", "no"})  # a single key may be pressed by chance
            sentence = f"{self._protocol.file.consent} {self._words.agree}"
            self._say(sentence, answers, self._consented, typed=self._words.full_word.format(**answers))
        else:
            self._welcome()

    def respond(self, question: int, answer: str) -> None:
        now, given = self._shown, self._read.get(plain(answer))
        if not self._read and now.typed and self._protocol.takes(answer):
            given = answer
        if question == now.question and given is not None:
            then, self._then = self._then, lambda _: None  # once: a defect in it must not save an answer twice
            then(given)

    def close(self) -> None:
        """After the studio has stopped."""
        if self._answers:
            self._answers.__exit__(None, None, None)

    def _open(self) -> None:
        bench = self._studio.bench
        info, simulated = bench.device.info, bench.simulated
        self._answers = Answers(
            self._protocol, self._folder, self._participant, consent=True, device=info.model or info.backend,
            device_simulated=simulated,
        )  # fmt: skip

    def _consented(self, answer: str) -> None:
        if answer == "no":
            self._say(self._words.declined)
            return
        try:
            self._open()
        except (PuncturaError, OSError) as bad:
            self._pause(bad, self._consented)
        else:
            self._welcome()

    def _welcome(self) -> None:
        assert self._answers
        sentence = self._protocol.file.instruction or self._words.begins
        if kept := self._answers.kept:
            sentence = self._words.resumed.format(done=kept, trials=len(self._answers.course))
        self._say(sentence, GO, lambda _: self._next())

    def _next(self) -> None:
        assert self._answers
        if (trial := self._answers.next()) is None:
            self._say(self._words.last)
            return
        before, self._block, self._trial, self._attempt = self._block, trial.block, trial, 0
        if before in (None, trial.block):
            self._begin()
        else:
            seconds = self._protocol.file.trials.break_s
            rest = "" if seconds is None else f" {self._words.rest.format(seconds=f'{float(seconds):g}')}"
            self._say(self._words.block + rest, GO, lambda _: self._begin())

    def _begin(self) -> None:
        """The run of a trial."""
        studio = self._studio
        if why := self._lost(studio.run.fault):  # only a person turns it on again, docs/safety.md
            self._tell(f'{why}; "{self._words.go_on}" at the page turns the force on again')
            self._say(f"{getattr(self._words, why.word)} {self._words.back}", GO, lambda _: self._armed())
            return
        self._attempt += 1
        self._interval = 0
        about = {"participant": self._participant, "trial": self._trial.number}
        try:
            for file in recordings(self._folder, self._participant, f"{self._trial.number:04d}"):
                file.unlink(missing_ok=True)  # of attempts before, and what a kill left of one
            studio.begin_activity(self, self._scene(), None, self._name(), about, remind=False)
        except (PuncturaError, OSError) as bad:
            self._pause(bad, lambda _: self._armed())
        else:
            self._explore()

    def _lost(self, fault: Fault) -> Spoilt | None:
        """Why there is no force, if there is none. fault: of the run."""
        off = None if self._studio.arming.armed else Spoilt("off", "the force was turned off")
        return off if fault == Fault.none else faulted(fault)

    def _armed(self) -> None:
        if self._studio.run.fault != Fault.none:
            self._idle()
        self._studio.arm()
        self._begin()

    def _this(self) -> str:
        assert self._answers
        return f"trial {self._answers.course.at + 1} of {self._participant}"

    def _name(self) -> str:
        return f"{self._participant}-{self._trial.number:04d}-{self._attempt}"

    def _scene(self) -> Loaded:
        return replace(self._base, scene=self._trial.intervals[self._interval].scene)

    def _explore(self) -> None:
        """The interval begins: the needle may go through the tissue as soon as the view is uncovered."""
        self._say(self._words.wait)
        self._through = crossing(self._scene().scene, self._protocol.membrane, 1.0).through
        self._touched = self._was_through = self._over = self._uncovered = self._unmasked = False

    def _ready(self) -> bool:
        """Whether the force is whole and the stimulus has faded in: both grow by ticks, which may be slow."""
        run = self._studio.run
        whole = READY_S + float(run.loop.limits.ramp_time)
        return self._whole >= whole * run.rate and self._faded >= READY_S * run.rate

    def _sentence(self) -> str:
        assert self._answers
        words, course = self._words, self._answers.course
        sentence = (words.interval if self._protocol.intervals > 1 else words.trial).format(
            trial=course.at + 1, trials=len(course), interval=self._interval + 1, stroke=words.stroke
        )
        return f"{words.practice} {sentence}" if self._trial.kind == "practice" else sentence

    def _explored(self) -> None:
        """The needle was through and is out again."""
        self._interval += 1
        if self._interval == self._protocol.intervals:
            self._finish()
            return
        self._say(self._words.wait)
        self._faded = -math.inf  # until a tick takes the stimulus
        try:
            self._studio.edit(self._scene())
        except Exception as bad:  # also a defect: the trial is repeated, and the studio stays
            self._finish(Spoilt("failed", explain(bad)))
        else:
            self._explore()

    def _finish(self, reason: Spoilt | None = None) -> None:
        """Ends the run of the trial. reason: why the trial must be repeated, if it must."""
        self._say(self._words.wait)
        recording, scenes = self._folder / f"{self._name()}.parquet", [one.scene for one in self._trial.intervals]

        def finished(_: str, status: RecorderStatus) -> None:  # in a thread of its own
            then = partial(self._again, reason or Spoilt("failed", status.words))
            if status.trouble and not reason:  # the disk's
                then = partial(self._pause, status.fact, lambda _: self._armed())
            elif not (reason or status.words):
                try:
                    then = partial(self._ask, felt_of(recording, scenes, self._protocol.membrane))
                except Exception as bad:
                    then = partial(self._again, bad if isinstance(bad, Spoilt) else Spoilt("failed", explain(bad)))
            self._studio.jobs.post(then)

        if not self._studio.recording:  # the ticks have ceased, and ended the run
            self._again(reason or ENDED)
            return
        self._studio.end_run(finished)
        self._idle()

    def _idle(self) -> None:
        """A run without force and recording. If the device does not start, the next trial says so."""
        studio = self._studio
        idle = partial(studio.begin_activity, self, studio.run.loaded, studio.run.pose, remind=False)
        studio.defects.guard(idle)
        studio.run.loop.pause()

    def _again(self, why: Spoilt) -> None:
        self._studio.run.loop.pause()  # the run may be the one before, which began again
        self._tell(f"{self._this()} is repeated: {why}")
        words = getattr(self._words, why.word)
        self._say(f"{words} {self._words.repeated} {self._words.wait}", GO, lambda _: self._armed())

    def _pause(self, why: Exception | str, then: Then) -> None:
        """The participant calls the experimenter, whose terminal has the reason."""
        self._studio.run.loop.pause()
        text = why if isinstance(why, str) else sentence_of(why)
        if not text.endswith(FREE_SPACE):
            text = f"{text.rstrip('. ')}; {MEND}"
        self._tell(f'{text}, then press "{self._words.go_on}" at the page')
        self._say(self._words.paused, GO, then)

    def _ask(self, felt: list[Felt]) -> None:
        answers, question = self._protocol.answers, self._protocol.file.question
        number = "" if answers else self._words.number
        self._say(question, answers, lambda answer: self._save(answer, felt), typed=number)

    def _save(self, answer: str, felt: list[Felt]) -> None:
        trial, protocol = self._trial, self._protocol
        assert self._answers
        try:
            self._answers.add(trial, answer, felt, [f"{self._name()}.parquet"])
        except (PuncturaError, OSError) as bad:
            self._pause(bad, lambda _: self._save(answer, felt))
            return
        if trial.kind == "practice" and protocol.intervals > 1 and not protocol.compares:
            right = counted(protocol, trial.position, answer)
            self._remark = f"{self._words.right if right else self._words.wrong} "
        self._next()

    def _say(
        self, sentence: str, answers: Mapping[str, str] = {}, then: Then = lambda answer: None,
        covered: bool = True, typed: str = "",
    ) -> None:  # fmt: skip
        """answers: the key of each. covered, typed: see SittingMessage."""
        read = {name: getattr(self._words, name, name) for name in answers}
        self._read = {plain(text): name for name, text in read.items()}
        keys = [AnswerKey(name=read[name], key=key) for name, key in answers.items()]
        new = {"question": self._shown.question + 1, "sentence": self._remark + sentence, "answers": keys}
        self._shown = self._shown.model_copy(update={"covered": covered, "typed": typed, **new})
        self._then = then
        if sentence != self._words.wait:
            self._remark = ""
        self._studio.out.send(self._shown)

    # The activity of the runs.

    def begin(self, scene: Scene) -> None:
        self._whole = self._faded = 0.0
        self._last = -1

    def ticks(self, ticks: Ticks, now: float) -> Sequence[BaseModel]:
        self._press(ticks.buttons)
        self._whole = _since(ticks.state != ServoState.active, self._whole)
        gaps = np.diff(ticks.tick.astype(np.int64), prepend=self._last) != 1  # a tick that was lost may have taken it
        self._last = int(ticks.tick[-1])
        self._faded = _since(gaps | (ticks.commands & COMMAND_SCENE != 0), self._faded)
        if self._over:
            return ()
        inside = ~np.isin(ticks.phase, (int(Phase.outside), ABSENT))
        outside = not inside[-1].any()
        self._unmasked |= self._protocol.file.noise and not self.noise_plays and bool(inside.any())
        self._touched |= not outside
        self._was_through |= bool((ticks.depth[:, self._protocol.membrane] >= self._through).any())
        if not self._uncovered and self._ready():
            self._uncovered = True
            self._say(self._sentence(), covered=not self._protocol.file.picture)
        elif self._touched and not self._was_through and outside:
            self._touched = False
            self._say(f"{self._words.deeper} {self._sentence()}", covered=not self._protocol.file.picture)
        why = self._lost(Fault(int(ticks.fault[-1]))) or (UNMASKED if self._unmasked and outside else None)
        if why or (self._was_through and outside):
            self._over = True
            self._studio.jobs.post(partial(self._finish, why) if why else self._explored)
        return ()

    def _press(self, buttons: npt.NDArray[np.integer]) -> None:
        """The device's first button gives the first answer, the second one the second; no button gives consent."""
        before, self._held = self._held, int(buttons[-1])
        pressed = int(np.bitwise_or.reduce(buttons & ~np.append(before, buttons[:-1]).astype(buttons.dtype)))
        pressed &= ~int(self._studio.bench.settings.limits.gate.get("dead_man", 0))
        first = next((one for bit, one in enumerate(self._shown.answers) if pressed >> bit & 1), None)
        if first and self._answers:
            self._studio.jobs.post(partial(self.respond, self._shown.question, first.name))

    def scene_change(self) -> None:
        """A stimulus of the trial."""

    def stop(self) -> None:
        if not self._over:  # the ticks have ceased
            self._over = True
            self._studio.jobs.post(lambda: self._finish(ENDED))

    def finish(self) -> Outcome:
        return Outcome()


def _since(breaks: npt.NDArray[np.bool_], before: float) -> float:
    """Ticks since the last break. before: as many as there were before these ticks."""
    last = np.flatnonzero(breaks)
    return float(len(breaks) - 1 - last[-1]) if len(last) else before + len(breaks)
