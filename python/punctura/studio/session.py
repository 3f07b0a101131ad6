"""The studio's worker: one thread that owns device, loop and hand, does what pages ask, and sends ticks to them.

A tick runs on the device's thread and never waits for this one.
"""

import math
import threading
import time
from collections.abc import Callable
from concurrent.futures import Future
from typing import TypeVar

from punctura._core import Device, ReplayDevice
from punctura.exercise import ResultStore
from punctura.studio.activity import Sitting
from punctura.studio.catalog import Exercises
from punctura.studio.experts import Experts
from punctura.studio.hand import SimulatedThumb
from punctura.studio.health import no_ticks, recording_status, status_of
from punctura.studio.loaded import Loaded
from punctura.studio.pump import Publisher
from punctura.studio.run import Run, Settings
from punctura.studio.runs import Runs
from punctura.studio.shelf import Shelf
from punctura.studio.wire.messages import Notice
from punctura.studio.wire.requests import Target

T = TypeVar("T")

SITTING_RUNS = "a participant's session runs"  # why a request is refused
PUMP_S = 1 / 60
STATUS_S = 0.25
AT_ONCE = 2048  # ticks in one turn, or four turns' worth; after a stall, requests are served between the turns


class Session(Runs):
    """`start`, then `call` with jobs for the worker; `stop` leaves no force on every way out."""

    def __init__(
        self,
        loaded: Loaded,
        settings: Settings,
        out: Publisher,
        shelf: Shelf,
        results: ResultStore,
        exercises: Exercises | None = None,
    ) -> None:
        """Raises DeviceError, ConfigurationError; then nothing runs."""
        super().__init__(loaded, settings, out, shelf)
        self.results = results
        self.exercises = exercises or Exercises()
        self.experts = Experts(results.folder, lambda text: self.jobs.post(lambda: out.send(Notice(text=text))))
        self.failure: BaseException | None = None
        self.sitting: Sitting | None = None  # a participant's session, which takes the studio for itself
        self.thumb = SimulatedThumb()
        self._rounds = Rounds()
        self._target: Target | None = None
        self._silent: Run | None = None  # the last run whose ticks ceased
        self._stopping = threading.Event()
        self._thread = threading.Thread(target=self._work, name="punctura-studio", daemon=True)

    def start(self) -> None:
        self._thread.start()

    def stop(self) -> None:
        """Zero force; returns when the device has stopped and the recording is complete."""
        self._stopping.set()
        self.pause()  # the worker may be busy
        self.jobs.post(lambda: None)
        if self._thread.is_alive():
            self._thread.join()

    @property
    def running(self) -> bool:
        return self._thread.is_alive()

    def call(self, job: Callable[[], T], pauses: int | None = None) -> Future[T]:
        """From any thread: runs `job` in the worker's thread; the future gets its result or its exception.

        pauses: `arming.pauses` when the user asked for it; now if not given. A job does not arm after a later pause.
        """
        asked_at = self.arming.pauses if pauses is None else pauses

        def obey() -> T:
            self.arming.asked_at(asked_at)
            return job()

        return self.jobs.call(obey)

    def pause(self) -> None:
        """From any thread: takes the force away at once, even if the worker is busy."""
        self.arming.pause(lambda: self.run.loop)

    def target(self, wish: Target) -> None:
        """From any thread: where the simulated hand must go. A later target replaces one that still waits."""
        self.heard.hear()
        waiting, self._target = self._target, wish
        if waiting is None:
            self.jobs.post(self._take_target)

    # Everything below belongs to the worker's thread.

    def _send_silence(self) -> None:
        """Reports once that the ticks of the present run have ceased. The loop stops by itself."""
        run, words = self.run, self.run.silence
        if words and run is not self._silent:
            self._silent = run
            self.out.send(no_ticks(words))
            self.defects.guard(self.end_run)
            thumb = run.thumb.device.trouble() if run.thumb else ""
            if trouble := run.loop.device.trouble() or thumb:  # after the stop: the driver may take time to answer
                self.out.send(no_ticks(f"{words}. {trouble}"))

    def _take_target(self) -> None:
        wish, self._target = self._target, None
        # A page that does not know of the new run yet means a place in the run before.
        if wish is not None and wish.run == self.run.number:
            try:
                self.hand.target(wish.position, wish.axis, wish.buttons)
            except ValueError as error:
                self.out.send(Notice(text=str(error)))

    def _work(self) -> None:
        try:
            self.start_run()
            self._serve()
        except BaseException as error:
            self.failure = error
        finally:
            self.run.stop()
            self.defects.guard(self.end_run)
            self.takes.wait()

    def _serve(self) -> None:
        pump_at = status_at = time.monotonic()
        while not self._stopping.is_set():
            self.jobs.do_next(min(pump_at, self.hand.next_at) - time.monotonic())
            self.arming.asked_at(self.arming.pauses)  # what follows is the worker's own work
            now = time.monotonic()
            self.hand.drive(now)
            self.thumb.turn(self.run.loop, now)
            self._send_silence()
            if now >= pump_at:
                self.defects.guard(self._take_turn)
                pump_at = max(pump_at + PUMP_S, now)
            if self.activities.due(now):
                self.defects.guard(lambda: self.begin_again(remind=False))
            if now >= status_at:
                status_at = now + STATUS_S
                self.defects.guard(self._send_status)
                if self._rounds.due(self.run.loop.device, bool(self.recording), now):
                    self.defects.guard(lambda: self.begin_again(remind=False))

    def _take_turn(self) -> None:
        self.turn(max(AT_ONCE, int(4 * PUMP_S * self.run.rate)))

    def _send_status(self) -> None:
        self.out.send(status_of(self.run, self.pump.lost, self.arming.armed, self.hand.mode, self.compare))
        if self.run.recorder and self.recording:
            self.out.send(recording_status(self.recording, self.run))


REST_S = 2.0  # between two rounds


class Rounds:
    """A device that plays a recorded motion plays it again after a rest."""

    def __init__(self) -> None:
        self._over_at = math.inf

    def due(self, device: Device, recording: bool, now: float) -> bool:
        """Whether the next round must begin. recording: a run that is recorded is not repeated."""
        over = isinstance(device, ReplayDevice) and device.finished and not recording
        self._over_at = min(self._over_at, now) if over else math.inf
        if now - self._over_at < REST_S:
            return False
        self._over_at = math.inf
        return True
