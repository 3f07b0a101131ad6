"""A session with a person: stimuli on a device by the live loop, answers by keys in the terminal."""

from __future__ import annotations

import contextlib
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

from punctura import Scene
from punctura._core import Device, ForceLimits, ServoLoop
from punctura.compare.run import recorded_run
from punctura.errors import ConfigurationError, Problem
from punctura.events import crossing
from punctura.live import RunLimits, RunSummary, fit_conditioning, fit_direction, open_for, run_live
from punctura.perception.course import Trial, counted
from punctura.perception.protocol import Protocol, Stimulus
from punctura.perception.session import DiskFullError, Session
from punctura.perception.stimulus import Felt, cut_by_limits, felt
from punctura.record import Recorder

INTERVAL_S = 6.0  # of one stroke, if the protocol has no time


class Terminal(NamedTuple):
    """Where a session prints, asks and opens devices."""

    say: Callable[[str], None]
    ask: Callable[[str], str]  # prints a text, and returns the line that is typed
    open_device: Callable[[Scene], Device]
    limits: RunLimits = RunLimits()


def device_of(name: str) -> Callable[[Scene], Device]:
    """Opens the device of a name for a scene, as `punctura run --device` does."""
    return lambda scene: open_for(scene, name)


def check_device(protocol: Protocol, limits: ForceLimits) -> None:
    """Raises ConfigurationError with each level that a device with these limits cannot show."""
    asked = [(f"stimulus.levels[{i}]", one) for i, one in enumerate(protocol.stimuli)]
    asked += [("stimulus.reference", one) for one in protocol.references[:1]]
    asked += [("trials.catch_level", protocol.catch)] if protocol.catch else []
    problems = [Problem(key, one.level, reason) for key, one in asked if (reason := cut_by_limits(one.scene, limits))]
    if problems:
        raise ConfigurationError(problems, str(protocol.path))


def run_session(protocol: Protocol, folder: Path, participant: str, terminal: Terminal) -> int:
    """A whole session, or the rest of one. Returns the number of answered trials.

    Raises ConfigurationError before the start for levels that the device cannot show, SessionError, DeviceError.
    """
    check_device(protocol, terminal.limits.force)
    say, file = terminal.say, protocol.file
    agreed = not file.consent or _consent(terminal, file.consent)
    with Session(protocol, folder, participant, agreed) as session:
        if session.kept:
            say(f"{session.kept} of {len(session.course)} trials are done; the session goes on with the next one.")
        else:
            say(file.instruction)
        block: int | None = None
        while (trial := session.next()) is not None:
            if block is not None and trial.block != block:
                _pause(terminal, file.trials.break_s)
            block = trial.block
            say(f"Trial {trial.number + 1} of {len(session.course)}{', practice' * (trial.kind == 'practice')}")
            shown, names = _presented(protocol, folder, participant, trial, terminal)
            answer = _answer(protocol, terminal)
            _saved(session, trial, answer, shown, names, terminal)
            if trial.kind == "practice" and not protocol.compares:
                say("Right." if counted(protocol, trial.position, answer) else "That was another one.")
        say("That was the last trial. Thank you.")
        return session.course.at


def _consent(terminal: Terminal, text: str) -> bool:
    return terminal.ask(f"{text}\nDo you agree? Type yes: ").strip().casefold() == "yes"


def _pause(terminal: Terminal, seconds: object) -> None:
    rest = "" if seconds is None else f" Rest for at least {float(str(seconds)):g} s."
    terminal.ask(f"A block is over.{rest} Press Enter to go on: ")


def _answer(protocol: Protocol, terminal: Terminal) -> str:
    keys = {key.casefold(): name for name, key in protocol.answers.items()}
    choice = ", ".join(f"{key} = {name}" for name, key in protocol.answers.items())
    while True:
        typed = terminal.ask(f"{protocol.file.question} ({choice}): ").strip().casefold()
        if typed in keys:
            return keys[typed]
        terminal.say(f"Type one of the keys {', '.join(protocol.answers.values())}.")


def _saved(
    session: Session, trial: Trial, answer: str, shown: list[Felt], names: list[str], terminal: Terminal
) -> None:
    while True:
        try:
            session.add(trial, answer, shown, names)
            return
        except DiskFullError as full:
            terminal.ask(f"{full}. Press Enter to save it again: ")


def _presented(
    protocol: Protocol, folder: Path, participant: str, trial: Trial, terminal: Terminal
) -> tuple[list[Felt], list[str]]:
    """What was felt in each interval, and the names of the recordings. A bad interval repeats the whole trial."""
    while True:
        shown: list[Felt] = []
        names: list[str] = []
        for i, stimulus in enumerate(trial.intervals):
            terminal.say(f"Interval {i + 1}" if protocol.intervals > 1 else "Now")
            names.append(f"{participant}-{trial.number:04d}-{i + 1}.parquet")
            found, reason = _interval(protocol, stimulus, folder / names[-1], terminal)
            if found is None:
                terminal.say(f"The trial is repeated: {reason}")
                break
            shown.append(found)
        else:
            return shown, names


def _interval(protocol: Protocol, stimulus: Stimulus, recording: Path, terminal: Terminal) -> tuple[Felt | None, str]:
    """One stroke on the device: what was felt, or the reason to repeat it."""
    device = terminal.open_device(stimulus.scene)
    scene = fit_conditioning(fit_direction(stimulus.scene, device)[0], device)[0]
    recording.unlink(missing_ok=True)  # of a trial that a kill ended before its answer
    seconds = protocol.file.trials.interval_s
    summary = run_live(
        device, scene, INTERVAL_S if seconds is None else float(seconds), terminal.limits.gate_on(device),
        terminal.limits.force, prepare=_recorder(recording),
    )  # fmt: skip
    reason = _spoilt(summary, scene, protocol.membrane)
    if reason:
        with contextlib.suppress(FileNotFoundError):
            recording.unlink()
        return None, reason
    return felt(recorded_run(recording), protocol.membrane, summary.force_scale), ""


def _recorder(path: Path) -> Callable[[ServoLoop], Callable[[], None]]:
    def begin(loop: ServoLoop) -> Callable[[], None]:
        recorder = Recorder(loop, path)

        def finish() -> None:
            recorder.finish()

        return finish

    return begin


def _spoilt(summary: RunSummary, scene: Scene, membrane: int) -> str:
    """Why an interval must be repeated; empty if it was felt as planned."""
    if summary.fault:
        return summary.fault
    if summary.lost:
        return f"{summary.lost} ticks were lost"
    if summary.limited_ticks:
        return f"the force was cut by {summary.limits_in_words}"
    name, needed = scene.membranes[membrane].name, crossing(scene, membrane, 1.0).through
    if summary.deepest_m[membrane] < needed:
        return f"the needle did not go through the {name}, {needed * 1e3:.1f} mm deep"
    return ""
