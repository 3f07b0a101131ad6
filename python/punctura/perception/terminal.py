"""A session with a person: stimuli on a device by the live loop, answers by keys in the terminal."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

from punctura import Scene
from punctura._core import Device, ForceLimits, ReplayDevice, ServoLoop, SimulatedDevice
from punctura.compare.run import recorded_run
from punctura.errors import ConfigurationError, Problem
from punctura.events import crossing
from punctura.live import RunLimits, RunSummary, fit_conditioning, fit_direction, open_for, run_live
from punctura.perception.course import Trial, counted
from punctura.perception.protocol import Protocol, Stimulus
from punctura.perception.session import DiskFullError, Session
from punctura.perception.stimulus import Felt, cut_by_limits, felt
from punctura.record import Recorder, RecordingError
from punctura.record.finish import part_path

INTERVAL_S = 6.0  # of one stroke, if the protocol has no time


class Terminal(NamedTuple):
    """Where a session prints, asks and opens devices."""

    say: Callable[[str], None]
    ask: Callable[[str], str]  # prints a text, and returns the line that is typed
    open_device: Callable[[Scene], Device]
    limits: RunLimits = RunLimits()


def device_of(name: str) -> Callable[[Scene], Device]:
    """Opens the device of a name for a scene, as `punctura run --device` does.

    All intervals have one device, so the long-run limit of its force holds over all of them.
    """
    last: list[Device] = []

    def opened(scene: Scene) -> Device:
        if last and not isinstance(last[0], SimulatedDevice | ReplayDevice):
            return last[0]
        device = open_for(scene, name)
        if last:
            device.go_on_from(last[0])
        last[:] = [device]
        return device

    return opened


READY = "Hold the needle in front of the tissue, and press Enter: "


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
    info, force = terminal.open_device(protocol.stimuli[0].scene).info, terminal.limits.force
    ratings = {key: min(getattr(force, key), getattr(info, key)) for key in ("max_force", "continuous_force")}
    check_device(protocol, force.replace(**ratings))  # a rating that is not known is NaN, and changes nothing
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
            say(f"Trial {session.course.at + 1} of {len(session.course)}{', practice' * (trial.kind == 'practice')}")
            shown, names = _presented(protocol, folder, participant, trial, terminal)
            answer = _answer(protocol, terminal)
            _saved(session, trial, answer, shown, names, terminal)
            if trial.kind == "practice" and protocol.intervals > 1 and not protocol.compares:
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
        typed = terminal.ask(f"{protocol.file.question} ({choice or 'a number above 0'}): ").strip().casefold()
        if typed in keys:
            return keys[typed]
        if not keys and re.fullmatch(r"\d{1,9}(\.\d{1,9})?|\.\d{1,9}", typed) and float(typed) > 0:
            return typed
        terminal.say(f"Type one of the keys {', '.join(protocol.answers.values())}." if keys else "Type such as 2.5.")


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
            which = f"Interval {i + 1} of {protocol.intervals}. " if protocol.intervals > 1 else ""
            terminal.ask(which + READY)  # a force begins only when the person has the device in the hand
            names.append(f"{participant}-{trial.number:04d}-{i + 1}.parquet")
            found, reason = _interval(protocol, stimulus, folder / names[-1], terminal)
            if found is None:
                # The force comes back by a person alone, docs/safety.md; and a full disk gets time.
                terminal.ask(f"The trial is repeated: {reason.rstrip('. ')}. Press Enter when you are ready: ")
                break
            shown.append(found)
        else:
            return shown, names


def _interval(protocol: Protocol, stimulus: Stimulus, recording: Path, terminal: Terminal) -> tuple[Felt | None, str]:
    """One stroke on the device: what was felt, or the reason to repeat it."""
    device = terminal.open_device(stimulus.scene)
    scene = fit_conditioning(fit_direction(stimulus.scene, device)[0], device)[0]
    _discard(recording)  # of a trial that a kill ended before its answer
    seconds = protocol.file.trials.interval_s
    recorders: list[Recorder] = []
    try:
        summary = run_live(
            device, scene, INTERVAL_S if seconds is None else float(seconds), terminal.limits.gate_on(device),
            terminal.limits.force, prepare=_recorder(recording, recorders),
        )  # fmt: skip
    except RecordingError as bad:
        return None, str(bad)
    reason = _spoilt(summary, scene, protocol.membrane) or _unrecorded(recorders[0])
    run = None if reason else recorded_run(recording)
    if run is not None and run.depth[0] > 0:
        reason = "the needle was in the tissue at the start: draw it back first"
    if run is None or reason:
        _discard(recording)
        return None, reason
    return felt(run, protocol.membrane, summary.force_scale), ""


def _discard(recording: Path) -> None:
    for path in (recording, part_path(recording)):
        path.unlink(missing_ok=True)


def _unrecorded(recorder: Recorder) -> str:
    """Why a recording is not whole; empty if it is."""
    status = recorder.status()
    if status.finished and not status.lost:
        return ""
    return ": ".join(["its recording is not whole", *status.unwritten])


def _recorder(path: Path, recorders: list[Recorder]) -> Callable[[ServoLoop], Callable[[], None]]:
    def begin(loop: ServoLoop) -> Callable[[], None]:
        recorders.append(Recorder(loop, path))

        def finish() -> None:
            recorders[0].finish()

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
    if not summary.force_was_on:
        return "the device gave no force"
    if summary.deepest_m[membrane] < crossing(scene, membrane, 1.0).through:
        return f"the needle did not go through the {scene.membranes[membrane].name}"  # how deep it is tells the level
    return ""
