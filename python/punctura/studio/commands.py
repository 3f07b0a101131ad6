"""Carries out the requests of a page: slow preparations in any thread, then a job in the worker's thread."""

import time
from collections.abc import Callable
from concurrent.futures import Future
from typing import TypeAlias

from punctura.defects import explain
from punctura.errors import ConfigurationError
from punctura.exercise import Exercise
from punctura.exercise.course import need_membranes
from punctura.live import room_note
from punctura.record import RecorderStatus, open_recording
from punctura.scene import scene_names
from punctura.studio.activity import ExerciseActivity
from punctura.studio.catalog import DRAFT
from punctura.studio.loaded import Loaded, from_name, from_tables, from_text, problem_parts
from punctura.studio.making import made_of, make
from punctura.studio.own_exercises import NameExists
from punctura.studio.recorded import motion_of
from punctura.studio.session import SITTING_RUNS, Session
from punctura.studio.wire import requests as ask
from punctura.studio.wire.messages import Notice, Reply

Done: TypeAlias = tuple[str, dict[str, str | int]]  # a reply's text and data
Job = Callable[[Session], "Done | Future[Done] | None"]


IN_SITTING = (ask.Respond, ask.Sound, ask.TripFault)  # and a pause; "Go on" turns the force on


class NotNow(ValueError):
    """The request is not possible in the present state; the text says why."""


def prepare(request: ask.NumberedRequest, session: Session) -> Job:
    """The worker's job for a request. Raises errors that `refusal` knows, and then changes nothing. A pause is not a
    job, see Session.pause."""
    if session.sitting and not isinstance(request, IN_SITTING):
        raise NotNow(SITTING_RUNS)
    match request:
        case ask.Respond():
            return lambda session: _respond(session, request)
        case ask.Sound():
            return lambda session: sound(session, request.plays)
        case ask.Arm():
            return lambda session: session.arm()
        case ask.Reset():
            return lambda session: session.reset()
        case ask.Compare():
            return lambda session: session.set_compare(request.on)
        case ask.Estimate():
            return lambda session: session.set_estimate(request.on)
        case ask.Strokes():
            return lambda session: _strokes(session, request.period)
        case ask.PushPlunger():
            return lambda session: _push_plunger(session, request.force)
        case ask.PlayMotion():
            motion = session.shelf.read(request.recording, lambda path: motion_of(open_recording(path)))
            return lambda session: _moves_by_itself(session, lambda: session.hand.motion(*motion, time.monotonic()))
        case ask.TripFault():
            return lambda session: _needs_simulated(session, lambda: session.bench.simulated_device.trip())
        case ask.Edit() | ask.Load() | ask.LoadText():
            return _prepare_scene(request)
        case ask.StartRecording() | ask.StopRecording() | ask.StartExercise() | ask.EndExercise():
            return _prepare_take(request, session)
        case ask.SetExpert():
            return _prepare_expert(request, session)
        case ask.CheckExercise() | ask.SaveExercise() | ask.OpenExercise() | ask.DeleteExercise():
            done = make(request, session.exercises)
            return lambda session: done
        case ask.TryExercise():
            return _prepare_trial(request, session)
    raise NotNow("this studio cannot do that")


def refusal(number: int, error: Exception) -> Reply:
    """The reply with the reason why a request was not done."""
    if isinstance(error, ConfigurationError):
        count = len(error.problems)
        words = f"{count} problem{'s' if count != 1 else ''}"
        return Reply(id=number, ok=False, text=words, problems=problem_parts(error.problems))
    if isinstance(error, NameExists):
        return Reply(id=number, ok=False, text=str(error), data={"exists": 1})
    return Reply(id=number, ok=False, text=explain(error))


def _respond(session: Session, request: ask.Respond) -> None:
    if session.sitting:
        session.sitting.respond(request.question, request.answer)


def sound(session: Session, plays: bool) -> None:
    """plays: whether the page that has control plays the masking noise."""
    if session.sitting:
        session.sitting.noise_plays = plays


def _prepare_scene(request: ask.Edit | ask.Load | ask.LoadText) -> Job:
    if isinstance(request, ask.Edit):
        loaded = from_tables(request.tables)
        return lambda session: _edit(session, loaded)
    if isinstance(request, ask.LoadText):
        loaded = from_text(request.toml)
    elif request.scene in scene_names():
        loaded = from_name(request.scene)
    else:
        raise NotNow(f"there is no ready scene {request.scene!r}")
    return lambda session: _load(session, loaded)


def _load(session: Session, loaded: Loaded) -> None:
    known = session.run.notes
    session.begin(loaded)
    for sentence in (*(note for note in session.run.notes if note not in known), *loaded.unusual):
        _notice(session, sentence)


def _notice(session: Session, sentence: str) -> None:
    session.out.send(Notice(text=sentence[:1].upper() + sentence[1:]))


def _room_notice(session: Session) -> None:
    """Warns the pages if the new run produces so many ticks that some may be lost."""
    if note := room_note(session.run.loop):
        _notice(session, note)


def _edit(session: Session, loaded: Loaded) -> Done:
    earlier = session.run.loaded.unusual
    session.edit(loaded)
    for sentence in (sentence for sentence in loaded.unusual if sentence not in earlier):
        _notice(session, sentence)
    if session.bench.simulated and loaded.scene.servo.rate != session.run.rate:
        return "the new rate takes effect in the next run", {}
    return "", {}


def _strokes(session: Session, period: float) -> None:
    scene = session.run.loaded.scene
    _moves_by_itself(session, lambda: session.hand.strokes(scene, period, time.monotonic()))


def _push_plunger(session: Session, force: float) -> None:
    if session.run.loaded.scene.syringe is None:
        raise NotNow("the scene has no syringe")
    session.thumb.push(session.run.loop, force, time.monotonic())


def _moves_by_itself(session: Session, do: Callable[[], None]) -> None:
    """A result is about a person, so the hand does not move by itself while a person is judged."""
    if activity := session.activities.now:
        raise NotNow(f"the {activity.what} judges your own hand; end it first")
    _needs_simulated(session, do)


def _needs_simulated(session: Session, do: Callable[[], None]) -> None:
    if not session.bench.simulated:
        raise NotNow("only a simulated device has a hand that the page can move")
    do()


def _prepare_take(
    request: ask.StartRecording | ask.StopRecording | ask.StartExercise | ask.EndExercise, session: Session
) -> Job:
    match request:
        case ask.StartRecording():
            _refuse_second(session)
            recording = session.shelf.new_name(request.name, session.run.loaded.scene.name)
            return lambda session: _start_recording(session, recording)
        case ask.StopRecording():
            return _stop_recording
        case ask.StartExercise():
            if request.exercise not in session.exercises.names():
                raise NotNow(f"there is no exercise {request.exercise!r}")
            exercise = session.exercises.load(request.exercise)
            loaded = from_name(exercise.scene_name)
            name = session.shelf.new_name(None, exercise.title)
            activity = _activity(request, exercise, name, session)
            return lambda session: _start_exercise(session, exercise, loaded, activity, name)
        case _:
            return _end_exercise


def _prepare_trial(request: ask.TryExercise, session: Session) -> Job:
    exercise = made_of(request.tables)
    loaded = from_name(exercise.scene_name)
    name = session.shelf.new_name(None, exercise.title)
    activity = _activity(request, exercise, name, session)

    def start(session: Session) -> Done:
        done = _start_exercise(session, exercise, loaded, activity, name)
        session.exercises.draft = exercise
        return done

    return start


def _activity(
    request: ask.StartExercise | ask.TryExercise, exercise: Exercise, recording: str, session: Session
) -> ExerciseActivity:
    results = session.exercises.drafts if exercise.name == DRAFT else session.results
    bench = session.bench
    second = bench.settings.second is not None
    person, group = request.person, request.group
    return ExerciseActivity(exercise, person, recording, results, group, second, session.heard, bench.simulated)


def _prepare_expert(request: ask.SetExpert, session: Session) -> Job:
    if request.exercise not in session.exercises.names():
        raise NotNow(f"there is no exercise {request.exercise!r}")
    if request.exercise == DRAFT:
        raise NotNow("a draft has no expert's run; save the exercise first")
    if request.recording:
        exercise = session.exercises.load(request.exercise)
        need_membranes(exercise.file, session.shelf.open(request.recording).info.scene)
    session.experts.set(request.exercise, request.recording)
    return lambda session: None


def _refuse_second(session: Session) -> None:
    if session.recording:
        raise NotNow(f"{session.recording} is being recorded; stop it first")


def _start_recording(session: Session, name: str) -> Done:
    _refuse_second(session)
    loaded = session.run.loaded
    session.begin(loaded, session.run.pose, name, {"title": name, "scene": loaded.tables()})
    _room_notice(session)
    return "", {"recording": name}


def _stop_recording(session: Session) -> Future[Done]:
    if not session.recording:
        raise NotNow("nothing is being recorded")
    if activity := session.activities.now:
        raise NotNow(f"the {activity.what} is recorded until it ends")
    done: Future[Done] = Future()

    def finished(name: str, status: RecorderStatus) -> None:
        done.set_result((status.words, {"recording": name, "rows": status.rows, "lost": status.lost}))

    session.end_run(finished)
    session.begin_again()
    return done


def _start_exercise(
    session: Session, exercise: Exercise, loaded: Loaded, activity: ExerciseActivity, name: str
) -> Done:
    pose = exercise.start_position, exercise.start_axis
    about = {"title": exercise.title, "exercise": exercise.name, "scene": loaded.tables()}
    session.begin_activity(activity, loaded, pose, name, about)
    return "", {"recording": name}


def _end_exercise(session: Session) -> None:
    if not session.activities.now:
        raise NotNow("there is no exercise to end")
    session.begin_again()
