"""The studio's worker: one thread that owns device, loop and hand, obeys requests, and pumps ticks to the pages.

The tick itself runs on the device's thread and never waits for this one.
"""

from __future__ import annotations

import math
import threading
import time
from collections.abc import Callable
from concurrent.futures import Future
from typing import Any, TypeVar

from punctura._core import DeviceError, Fault, ReplayDevice, ServoLoop, describe
from punctura.exercise import Exercise, ResultStore
from punctura.record import RecorderStatus
from punctura.studio.catalog import Exercises
from punctura.studio.hand import Hand, Pose
from punctura.studio.health import no_recording, recording_status, status_of
from punctura.studio.jobs import Jobs
from punctura.studio.loaded import Loaded
from punctura.studio.practice import Practice, no_exercise
from punctura.studio.pump import Publisher, Pump, no_fault
from punctura.studio.run import Bench, Run, Settings
from punctura.studio.shelf import Shelf
from punctura.studio.takes import Takes
from punctura.studio.view import scene_view
from punctura.studio.watchdog import Watchdog
from punctura.studio.wire.messages import FaultMessage, Notice, SceneMessage
from punctura.studio.wire.requests import Target

T = TypeVar("T")
Then = Callable[[str, RecorderStatus], None]  # name of a recording, and how it ended

PUMP_S = 1 / 60
STATUS_S = 0.25
ROUND_REST_S = 2.0  # between two rounds of a recorded motion


class Session:
    """`start`, then `call` whatever the worker shall do; `stop` leaves no force on every way out."""

    def __init__(
        self,
        loaded: Loaded,
        settings: Settings,
        out: Publisher,
        shelf: Shelf,
        results: ResultStore,
        exercises: Exercises | None = None,
    ) -> None:
        """Raises DeviceError, ConfigurationError: nothing runs then."""
        self.out, self.shelf, self.results = out, shelf, results
        self.exercises = exercises or Exercises()
        self.bench = Bench(settings, loaded.scene)
        self.hand = Hand()
        self.run = Run(0, self.bench, loaded)
        self.pump = Pump(self.run, out)
        self.practice: Practice | None = None
        self.recording = ""  # the name of the one that is being made
        self.armed = False
        self.pauses = 0  # that were asked for so far
        self._asked_at = 0  # how many of them had been when the request came that the worker obeys
        self._arming = threading.Lock()  # held for a moment only: `pause` waits for it
        self.compare = False
        self._result_comes = False  # of an exercise that has ended, once its recording is finished
        self.failure: BaseException | None = None
        self._defect = ""  # the last that was told
        self._takes = Takes()
        self._jobs = Jobs()
        self._target: Target | None = None
        self._over_at = math.inf  # when a recorded motion had ended
        self._stopping = threading.Event()
        self._watchdog = Watchdog(lambda loop, words: self._jobs.post(lambda: self._tell_ceased(loop, words)))
        self._thread = threading.Thread(target=self._work, name="punctura-studio", daemon=True)

    def start(self) -> None:
        self._thread.start()

    def stop(self) -> None:
        """Zero force; returns when the device is still, and a recording whole."""
        self._stopping.set()
        self.pause()  # the worker may have something to do first
        self._jobs.post(lambda: None)
        if self._thread.is_alive():
            self._thread.join()

    @property
    def running(self) -> bool:
        return self._thread.is_alive()

    def call(self, job: Callable[[], T], pauses: int | None = None) -> Future[T]:
        """From any thread: `job` in the worker's, and what it gave or raised.

        pauses: how many there were when the user asked for it, now if not given. A job does not arm after a later one.
        """
        asked_at = self.pauses if pauses is None else pauses

        def obey() -> T:
            self._asked_at = asked_at
            return job()

        return self._jobs.call(obey)

    def pause(self) -> None:
        """From any thread: takes the force away at once, whatever the worker does."""
        with self._arming:
            self.pauses += 1
            self.run.loop.pause()
            self.armed = False

    def target(self, wish: Target) -> None:
        """From any thread: where the simulated hand shall go. The last one counts."""
        waiting, self._target = self._target, wish
        if waiting is None:
            self._jobs.post(self._take_target)

    # What follows belongs to the worker's thread.

    def begin(
        self, loaded: Loaded, pose: Pose | None = None, record: str | None = None, about: dict[str, Any] | None = None
    ) -> None:
        """A new run; `record` is the name of its recording. Where it cannot be, the present scene is begun again, and
        the error raised."""
        path = self.shelf.file(record) if record else None
        self.end_run()
        try:
            self.run = Run(self.run.number + 1, self.bench, loaded, path, about, pose)
        except Exception:
            self.run = Run(self.run.number + 1, self.bench, self.run.loaded, pose=self.run.pose)
            self._start_run()
            raise
        self.recording = record or ""
        try:
            self._start_run()
        except Exception:  # the device cannot be started again: there is no tick, and nothing to record
            self.end_run()
            raise

    def edit(self, loaded: Loaded) -> None:
        """Another scene while it runs. Raises ConfigurationError; then nothing has changed."""
        self._turn()
        self.run.exchange(loaded)
        self._follow(self.pump.change(self.run.loop.scene, lambda: self._say_scene(new_run=False)))

    def arm(self) -> None:
        """Force once the tip is outside tissue, unless a pause was asked for after what the worker obeys now."""
        with self._arming:
            self.armed = self._asked_at == self.pauses
            if self.armed:
                self.run.loop.arm()

    def reset(self) -> None:
        """Leaves a fault. Where ticks had ceased, by a new run, which is armed only where the hand asks for it."""
        if not self.run.loop.running:
            self.begin_again()
            self.run.loop.pause()
        self.run.loop.reset()
        self.armed = False

    def set_compare(self, on: bool) -> None:
        self.compare = on
        self.pump.compare(on)

    def practise(self, exercise: Exercise, loaded: Loaded, person: str, name: str) -> None:
        """A new run with the exercise's scene, recorded under this name."""
        about = {"title": exercise.title, "exercise": exercise.name, "scene": loaded.tables()}
        self.begin(loaded, (exercise.start_position, exercise.start_axis), name, about)
        self.practice = Practice(exercise, self.run.loop.scene, person, name)

    def end_run(self, then: Then | None = None) -> None:
        """Ends the run. Finalizes the recording in the background; `then` gets the result, in that thread."""
        self.run.stop()
        self._turn()
        practice, self.practice = self.practice, None
        name, self.recording = self.recording, ""
        recorder, self.run.recorder = self.run.recorder, None
        if recorder is None:
            return
        self.out.say(no_recording())
        self._result_comes = practice is not None

        def tell(status: RecorderStatus) -> None:
            if status.words:
                self.out.say(Notice(text=f"Recording {name}: {status.words}"))
            if practice:
                self._guarded(lambda: self._keep(practice))
            if then:
                then(name, status)

        self._takes.finish(recorder, tell)

    def _keep(self, practice: Practice) -> None:
        """In the thread that has finished the recording: with it, the result is whole."""
        status = practice.keep(self.results, worthless=True)

        def tell() -> None:
            self._result_comes = False
            if self.practice is None:
                self.out.say(status)
            elif status.result:
                self.out.say(Notice(text=f"The result of the exercise before is kept as {status.result}."))

        self._jobs.post(tell)

    def begin_again(self) -> None:
        """The present scene as a new run, without a recording, from where the hand began."""
        self.begin(self.run.loaded, self.run.pose)

    def _start_run(self) -> None:
        self.pump = Pump(self.run, self.out)
        self.pump.compare(self.compare)
        self.hand.take(self.run.loop.device, self.run.pose)
        self.arm()
        self.out.say(no_fault())
        if not self._result_comes:
            self.out.say(no_exercise())
        self._say_scene(new_run=True)
        self.run.start()
        self._watchdog.watch(self.run.loop)

    def _tell_ceased(self, loop: ServoLoop, words: str) -> None:
        """Of a loop that the watchdog stops."""
        if loop is self.run.loop:
            self._say_ceased(words)
            self._guarded(self.end_run)
            if trouble := loop.device.trouble():  # after the stop: the driver may take time to answer
                self._say_ceased(f"{words}. {trouble}")

    def _say_ceased(self, words: str) -> None:
        self.out.say(FaultMessage(fault="device", reason=describe(Fault.device), trouble=words, tick=None, kept=0))

    def _say_scene(self, new_run: bool) -> None:
        view = scene_view(self.run.loaded, self.run.scenes, self.run.rate, self.pump.laws())
        self.out.say(SceneMessage(scene=view, new_run=new_run, run=self.run.number))

    def _take_target(self) -> None:
        wish, self._target = self._target, None
        # A page that has not heard of the new run yet still means the place where the hand was in the one before.
        if wish is not None and wish.run == self.run.number:
            try:
                self.hand.target(wish.position, wish.axis, wish.buttons)
            except ValueError as error:
                self.out.say(Notice(text=str(error)))

    def _turn(self) -> None:
        self._follow(self.pump.turn())

    def _follow(self, columns: dict[str, Any] | None) -> None:
        if self.practice and columns:
            status = self.practice.add(columns, time.monotonic())
            if status:
                self.out.say(status)

    def _work(self) -> None:
        try:
            self._watchdog.start()
            self._start_run()
            pump_at = status_at = time.monotonic()
            while not self._stopping.is_set():
                self._jobs.do_next(min(pump_at, self.hand.next_at) - time.monotonic())
                self._asked_at = self.pauses  # what follows is the worker's own
                now = time.monotonic()
                self.hand.drive(now)
                if now >= pump_at:
                    self._guarded(self._turn)
                    pump_at = max(pump_at + PUMP_S, now)  # a turn takes all there is
                if self.practice and self.practice.end_at and now >= self.practice.end_at:
                    self._guarded(self.begin_again)
                if now >= status_at:
                    status_at = now + STATUS_S
                    self._guarded(self._tell_status)
                    self._guarded(self._go_round)
        except DeviceError as error:
            self.failure = error
        except BaseException as error:
            self.failure = error
            raise
        finally:
            self.run.stop()
            self._guarded(self.end_run)
            self._watchdog.end()
            self._takes.wait()

    def _go_round(self) -> None:
        """A device that plays a recorded motion plays it again, unless it is being recorded."""
        now = time.monotonic()
        device = self.run.loop.device
        over = isinstance(device, ReplayDevice) and device.finished and not self.recording
        self._over_at = min(self._over_at, now) if over else math.inf
        if now - self._over_at >= ROUND_REST_S:
            self._over_at = math.inf
            self.begin_again()

    def _tell_status(self) -> None:
        self.out.say(status_of(self.run, self.pump.lost, self.armed, self.hand.mode, self.compare))
        if self.run.recorder and self.recording:
            self.out.say(recording_status(self.recording, self.run))

    def _guarded(self, step: Callable[[], Any]) -> None:
        """A defect in what only shows must not end the run, and is told once, not sixty times a second."""
        try:
            step()
        except Exception as error:
            text = f"a defect, please report it: {error!r}"
            if text != self._defect:
                self._defect = text
                self.out.say(Notice(text=text))
