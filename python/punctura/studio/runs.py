"""One run after another on one device, each with its recording and its activity."""

import queue
import threading
from collections.abc import Callable
from concurrent.futures import Future
from typing import TypeVar

from punctura._core import Fault, ServoLoop
from punctura.record import Recorder, RecorderStatus
from punctura.results import JsonObject
from punctura.studio.activity import Activities, Activity
from punctura.studio.followers import no_estimate
from punctura.studio.hand import Hand, Heard, Pose
from punctura.studio.health import STILL_OFF, no_recording
from punctura.studio.loaded import Loaded
from punctura.studio.pump import Defects, KeptTicks, Publisher, Pump, no_fault
from punctura.studio.run import Bench, Run, Settings
from punctura.studio.shelf import Shelf
from punctura.studio.view import scene_message
from punctura.studio.wire.messages import Notice


class Arming:
    """`pause` and `withhold` from any thread; everything else from the worker's."""

    def __init__(self) -> None:
        self.armed = False
        self.pauses = 0  # how many were asked for so far
        self._withheld = False  # until a person turns the force on
        self._asked_at = 0  # the value of `pauses` when the request came that the worker does now
        self._lock = threading.Lock()  # held only for a moment, because `pause` waits for it

    def pause(self, loop: Callable[[], ServoLoop]) -> None:
        """Takes the force away at once. loop: returns the present loop."""
        with self._lock:
            self.pauses += 1
            self._withheld = True
            loop().pause()
            self.armed = False

    def withhold(self) -> None:
        """No run gives force until a person turns it on: after a fault, ceased ticks, or a failed start."""
        with self._lock:
            self._withheld = True
            self.armed = False

    def asked_at(self, pauses: int) -> None:
        """The worker begins a request that came after so many pauses."""
        self._asked_at = pauses

    def begin(self, loop: ServoLoop) -> None:
        """A run begins: it may give force once the tip is outside tissue, unless force is withheld."""
        with self._lock:
            self.armed = not self._withheld
            if self.armed:
                loop.arm()

    def turn_on(self, loop: ServoLoop) -> None:
        """A person allows force once the tip is outside tissue. Does nothing if a pause came after this request."""
        with self._lock:
            if self._asked_at == self.pauses:
                self._withheld = False
                self.armed = True
                loop.arm()


T = TypeVar("T")


class Jobs:
    """`post` and `call` from any thread, `do_next` in the working thread."""

    def __init__(self) -> None:
        self._waiting: queue.SimpleQueue[Callable[[], None]] = queue.SimpleQueue()

    def post(self, job: Callable[[], None]) -> None:
        """Adds a job; nobody waits for its end."""
        self._waiting.put(job)

    def call(self, job: Callable[[], T]) -> Future[T]:
        """Adds a job. The future gets its result or its exception."""
        future: Future[T] = Future()

        def do() -> None:
            if not future.set_running_or_notify_cancel():
                return
            try:
                future.set_result(job())
            except Exception as error:
                future.set_exception(error)

        self._waiting.put(do)
        return future

    def do_next(self, seconds: float) -> None:
        """Does one job, if one comes within this time (s)."""
        try:
            job = self._waiting.get(timeout=seconds) if seconds > 0 else self._waiting.get_nowait()
        except queue.Empty:
            return
        job()


class Takes:
    """`finish` returns at once; `wait` returns when all are done."""

    def __init__(self) -> None:
        self._threads: list[threading.Thread] = []

    def finish(self, recorder: Recorder, then: Callable[[RecorderStatus], None]) -> None:
        """Finishes the recording of a stopped loop in a new thread, which then calls `then`."""
        thread = threading.Thread(target=lambda: then(recorder.finish()), name="punctura-finish")
        self._threads = [t for t in self._threads if t.is_alive()] + [thread]
        thread.start()

    def wait(self) -> None:
        for thread in self._threads:
            thread.join()


Then = Callable[[str, RecorderStatus], None]  # name of a recording, and how it ended


class Runs:
    """Belongs to one thread, the worker's."""

    def __init__(self, loaded: Loaded, settings: Settings, out: Publisher, shelf: Shelf) -> None:
        """Raises DeviceError, ConfigurationError; then nothing runs."""
        self.out, self.shelf = out, shelf
        self.jobs = Jobs()
        self.bench = Bench(settings, loaded.scene)
        self.hand = Hand()
        self.heard = Heard()
        self.run = Run(0, self.bench, loaded)
        self.kept_ticks = KeptTicks()
        self.pump = Pump(self.run, out, self.kept_ticks)
        self.arming = Arming()
        self.activities = Activities(out, self.jobs.post)
        self.defects = Defects(out)
        self.recording = ""  # the name of the present recording
        self.compare = self.estimate = False
        self.takes = Takes()

    def begin(
        self,
        loaded: Loaded,
        pose: Pose | None = None,
        record: str | None = None,
        about: JsonObject | None = None,
        remind: bool = True,
    ) -> None:
        """Starts a new run. If it fails, the present scene runs again, and the error is raised.

        record: the name of its recording. remind: send a notice if the force is still off: a person asked for this run.
        """
        path = self.shelf.file(record) if record else None
        self.end_run()
        try:
            try:
                self.run = Run(self.run.number + 1, self.bench, loaded, path, about, pose)
            except Exception:
                self.run = Run(self.run.number + 1, self.bench, self.run.loaded, pose=self.run.pose)
                self.start_run()
                raise
            self.recording = record or ""
            self.start_run(remind)
        except Exception:
            if not self.run.loop.running:  # the device does not start again: there is no tick, and nothing to record
                self.arming.withhold()
                self.end_run()
            raise

    def begin_activity(
        self,
        activity: Activity,
        loaded: Loaded,
        pose: Pose | None = None,
        record: str | None = None,
        about: JsonObject | None = None,
        remind: bool = True,
    ) -> None:
        """Starts a new run with this activity. Raises what `begin` and the activity's own `begin` raise."""
        self.begin(loaded, pose, record, about, remind)
        self.activities.begin(activity, self.run.loop.scene)

    def begin_again(self, remind: bool = True) -> None:
        """Runs the present scene again, without a recording, from the pose in which the hand began."""
        self.begin(self.run.loaded, self.run.pose, remind=remind)

    def edit(self, loaded: Loaded) -> None:
        """Sets another scene in the present run. Raises ConfigurationError, ValueError; then nothing has changed."""
        self.activities.scene_change()
        self.turn()
        self.run.exchange(loaded)
        send_scene = lambda: self.out.send(scene_message(self.run, self.pump.laws(), new_run=False))  # noqa: E731
        self.activities.ticks(self.pump.change(self.run.loop.scene, send_scene))

    def arm(self) -> None:
        """A person allows force once the tip is outside tissue, unless a pause came after the present request."""
        self.arming.turn_on(self.run.loop)

    def reset(self) -> None:
        """Clears a fault. If the ticks had ceased, a new run begins. There is no force until the user asks for it."""
        self.arming.withhold()
        if not self.run.loop.running:
            self.begin_again(remind=False)
        self.run.loop.reset()

    def set_compare(self, on: bool) -> None:
        self.compare = on
        self.pump.compare(on)

    def set_estimate(self, on: bool) -> None:
        self.estimate = on
        self.pump.estimate(on)
        if not on:
            self.out.send(no_estimate())

    def end_run(self, then: Then | None = None) -> None:
        """Ends the run. Finalizes the recording in the background; `then` gets the result, in that thread."""
        self.run.stop()
        if self.run.fault != Fault.none or self.run.silence:
            self.arming.withhold()
        self.turn()
        finish_activity = self.activities.stop()
        name, self.recording = self.recording, ""
        recorder, self.run.recorder = self.run.recorder, None
        if recorder is None:
            self.defects.guard(finish_activity)
            return
        self.out.send(no_recording())

        def finished(status: RecorderStatus) -> None:
            if status.words:
                self.out.send(Notice(text=f"Recording {name}: {status.words}"))
            self.defects.guard(finish_activity)
            if then:
                then(name, status)

        self.takes.finish(recorder, finished)

    def start_run(self, remind: bool = True) -> None:
        """Starts the present run, which has not ticked yet. remind: send a notice if the force is still off."""
        self.pump = Pump(self.run, self.out, self.kept_ticks)
        self.pump.compare(self.compare)
        self.pump.estimate(self.estimate)
        self.hand.take(self.run.loop.device, self.run.pose)
        self.heard.forget()
        self.arming.begin(self.run.loop)
        self.out.send(no_fault())
        self.activities.send_idle()
        if not self.recording:  # a page that was open before this studio may still show another one's recording
            self.out.send(no_recording())
        self.out.send(scene_message(self.run, self.pump.laws(), new_run=True))
        if remind and not self.arming.armed:
            self.out.send(Notice(text=STILL_OFF))
        self.run.start()

    def turn(self, most: int | None = None) -> None:
        """Sends the ticks that wait to the pages and to the activity, at most so many; all if not given."""
        self.activities.ticks(self.pump.turn(most))
