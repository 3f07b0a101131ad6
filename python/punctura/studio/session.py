"""The studio's worker: one thread that owns device, loop and hand, obeys requests, and pumps ticks to the pages.

The tick itself runs on the device's thread and never waits for this one.
"""

from __future__ import annotations

import queue
import threading
import time
from collections.abc import Callable
from concurrent.futures import Future
from typing import Any, TypeVar

from punctura.studio.hand import Hand
from punctura.studio.health import status_of
from punctura.studio.loaded import Loaded
from punctura.studio.pump import Publisher, Pump, no_fault
from punctura.studio.run import Bench, Run, Settings
from punctura.studio.view import scene_view
from punctura.studio.wire.messages import Notice, SceneMessage
from punctura.studio.wire.requests import Target

T = TypeVar("T")

PUMP_S = 1 / 60
STATUS_S = 0.25


class Session:
    """`start`, then `call` whatever the worker shall do; `stop` leaves no force on every way out."""

    def __init__(self, loaded: Loaded, settings: Settings, out: Publisher) -> None:
        """Raises DeviceError, ConfigurationError: nothing runs then."""
        self.out = out
        self.bench = Bench(settings, loaded.scene)
        self.hand = Hand()
        self.run = Run(0, self.bench, loaded)
        self.pump = Pump(self.run, out)
        self.armed = False
        self.compare = False
        self._jobs: queue.SimpleQueue[Callable[[], None]] = queue.SimpleQueue()
        self._target: Target | None = None
        self._stopping = threading.Event()
        self._thread = threading.Thread(target=self._work, name="punctura-studio", daemon=True)
        self.failure: BaseException | None = None

    def start(self) -> None:
        self._thread.start()

    def stop(self) -> None:
        """Zero force; returns when the device is still."""
        self._stopping.set()
        self._jobs.put(lambda: None)
        if self._thread.is_alive():
            self._thread.join()

    @property
    def running(self) -> bool:
        return self._thread.is_alive()

    def call(self, job: Callable[[], T]) -> Future[T]:
        """From any thread: `job` in the worker's, and what it gave or raised."""
        future: Future[T] = Future()

        def do() -> None:
            if not future.set_running_or_notify_cancel():
                return
            try:
                future.set_result(job())
            except Exception as error:
                future.set_exception(error)

        self._jobs.put(do)
        return future

    def target(self, wish: Target) -> None:
        """From any thread: where the simulated hand shall go. The last one counts."""
        waiting, self._target = self._target, wish
        if waiting is None:
            self._jobs.put(self._take_target)

    # What follows belongs to the worker's thread.

    def begin(self, loaded: Loaded) -> None:
        """A new run. Where it cannot be, the present scene is begun again, and the error raised."""
        self._end_run()
        try:
            self.run = Run(self.run.number + 1, self.bench, loaded)
        except Exception:
            self.run = Run(self.run.number + 1, self.bench, self.run.loaded)
            self._start_run()
            raise
        self._start_run()

    def edit(self, loaded: Loaded) -> None:
        """Another scene while it runs. Raises ConfigurationError; then nothing has changed."""
        self.pump.turn()
        self.run.exchange(loaded)
        self.pump.turn()
        self.pump.scene_changed()
        self._say_scene(new_run=False)

    def arm(self) -> None:
        self.run.loop.arm()
        self.armed = True

    def pause(self) -> None:
        self.run.loop.pause()
        self.armed = False

    def reset(self) -> None:
        self.run.loop.reset()
        self.armed = False

    def set_compare(self, on: bool) -> None:
        self.compare = on
        self.pump.compare(on)

    def _start_run(self) -> None:
        self.pump = Pump(self.run, self.out)
        self.pump.compare(self.compare)
        self.hand.take(self.run.loop.device, self.run.loaded.scene)
        self.armed = True
        self.out.say(no_fault())
        self._say_scene(new_run=True)
        self.run.start()

    def _end_run(self) -> None:
        self.run.stop()
        self.pump.turn()

    def _say_scene(self, new_run: bool) -> None:
        view = scene_view(self.run.loaded, self.run.scenes, self.run.rate)
        self.out.say(SceneMessage(scene=view, new_run=new_run))

    def _take_target(self) -> None:
        wish, self._target = self._target, None
        if wish is not None:
            try:
                self.hand.target(wish.position, wish.axis, wish.buttons)
            except ValueError as error:
                self.out.say(Notice(text=str(error)))

    def _work(self) -> None:
        try:
            self._start_run()
            pump_at = status_at = time.monotonic()
            while not self._stopping.is_set():
                now = time.monotonic()
                self._wait(min(pump_at, self.hand.next_at) - now)
                now = time.monotonic()
                self.hand.drive(now)
                if now >= pump_at:
                    self._guarded(self.pump.turn)
                    pump_at = max(pump_at + PUMP_S, now)  # a turn takes all there is
                if now >= status_at:
                    status_at = now + STATUS_S
                    self._guarded(lambda: self.out.say(status_of(self)))
        except BaseException as error:
            self.failure = error
            raise
        finally:
            self.run.stop()

    def _wait(self, seconds: float) -> None:
        try:
            job = self._jobs.get(timeout=seconds) if seconds > 0 else self._jobs.get_nowait()
        except queue.Empty:
            return
        job()

    def _guarded(self, step: Callable[[], Any]) -> None:
        """A defect in what only shows must not end the run."""
        try:
            step()
        except Exception as error:
            self.out.say(Notice(text=f"a defect, please report it: {error!r}"))
