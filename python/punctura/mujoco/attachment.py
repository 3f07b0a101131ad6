"""Needles that are attached to a MuJoCo model: steps, forces, a callback."""

from __future__ import annotations

import contextlib
import threading
import warnings
import weakref
from collections.abc import Callable, Iterator, Sequence
from typing import Any

import numpy as np

from punctura import Phase
from punctura.extras import optional
from punctura.mujoco.implicit import StabilityWarning, stability_text
from punctura.mujoco.kinematics import Array, Link, Relative, mobility, relative, without
from punctura.mujoco.needles import Needles, Tick, pack, unpack

_PATIENCE_S = 2.0  # for the step of another thread; a block of acting() takes longer
_NO_CALL = "Python exception raised"  # MuJoCo's words if it cannot call Python, as for a model that it still compiles
_callback = threading.RLock()  # of mjcb_control, of which MuJoCo has one


class Attachment:
    """Needles attached to a model; `attach` makes it. Each MjData has needles of its own, with their own past.

    Use it in one of two ways: `step(data)` in place of mujoco.mj_step, or `with attachment.acting():` around code that
    calls mj_step itself. Both give the same bits.
    """

    def __init__(self, model: Any, links: Sequence[Link], *, implicit: bool, forget: Callable[[Any], None]) -> None:
        self._mujoco = optional("mujoco", "mujoco", "punctura.mujoco")
        self.model = model
        self.implicit = implicit
        self._links = list(links)
        self._forget = forget
        self._timestep = float(model.opt.timestep)
        self._needles: weakref.WeakKeyDictionary[Any, Needles] = weakref.WeakKeyDictionary()
        self._in_use = threading.Lock()
        self._before: Callable[[Any, Any], None] | None = None  # the callback that was there before acting()
        self._warned: set[int] = set()

    def __repr__(self) -> str:
        pairs = ", ".join(f"{link.needle!r} in {link.tissue!r}" for link in self._links)
        return f"<Attachment of {pairs}: {'implicit' if self.implicit else 'explicit'}>"

    # Steps

    def step(self, data: Any) -> None:
        """One step of MuJoCo with the force of the needles, in place of mujoco.mj_step(model, data).

        Raises RuntimeError inside acting(), and if data was stepped or reset without the needles.
        """
        with self._alone(
            "the needles act through acting() now, so step() would make the step twice. Call "
            "mujoco.mj_step(model, data), or leave the block of acting() first. If another thread is in step(), "
            "wait for it: one thread at a time may use an Attachment"
        ):
            if self.model.opt.integrator == self._mujoco.mjtIntegrator.mjINT_RK4:  # four stages
                with self._installed():
                    self._mujoco.mj_step(self.model, data)
            else:  # what mj_step does, without a callback: MuJoCo has one for all models and threads
                self._of(data)
                self._mujoco.mj_step1(self.model, data)
                self._act(data)
                self._mujoco.mj_step2(self.model, data)
            self._needles[data].end_step(data.time)

    @contextlib.contextmanager
    def acting(self) -> Iterator[None]:
        """Inside the block, each mj_step of the model has the force of the needles.

        Uses MuJoCo's mjcb_control, and calls a callback that is installed there already first. It may be called
        several times a step (RK4, mj_forward): the needles move on only when a step has ended. Raises RuntimeError if
        another callback has replaced it inside the block, or if another thread is inside such a block: MuJoCo has one
        callback for all models and threads. MuJoCo cannot load a model while it has a callback: load it before.

        Between two steps the force is part of data.xfrc_applied: set forces of your own there, do not add to it.
        """
        with self._alone("acting() is in use already: its force must not be added twice"), self._installed():
            yield

    @contextlib.contextmanager
    def _alone(self, message: str) -> Iterator[None]:
        """One use at a time; takes the forces away at its end. Raises RuntimeError with the message."""
        if not self._in_use.acquire(blocking=False):
            raise RuntimeError(message)
        try:
            self._usable()
            yield
        finally:
            for data, needles in self._needles.items():
                needles.applied.take_away(data)
            self._in_use.release()

    @contextlib.contextmanager
    def _installed(self) -> Iterator[None]:
        """Inside the block, MuJoCo calls _on_control."""
        if self.model.opt.disableflags & self._mujoco.mjtDisableBit.mjDSBL_ACTUATION:
            raise RuntimeError(
                "the model has actuation disabled, and MuJoCo then calls no mjcb_control, so the needles cannot act: "
                "clear mjDSBL_ACTUATION in model.opt.disableflags, or use step() with another integrator than RK4"
            )
        if not _callback.acquire(timeout=_PATIENCE_S):
            raise RuntimeError(
                "another thread is inside acting(), and MuJoCo has one mjcb_control for all models and threads: use "
                "step() with another integrator than RK4, which needs none, or one process for each model"
            )
        try:
            before, mine = self._mujoco.get_mjcb_control(), self._on_control
            self._before = before
            self._mujoco.set_mjcb_control(mine)
            try:
                yield
            except (ValueError, RuntimeError, self._mujoco.FatalError) as error:
                if _NO_CALL not in str(error):
                    raise
                raise RuntimeError(
                    "MuJoCo cannot load a model while a Python callback is installed, as inside acting(), in any "
                    f"thread: load it before the block, or use step() ({error})"
                ) from error
            finally:
                replaced = self._mujoco.get_mjcb_control() != mine
                if not replaced:
                    self._mujoco.set_mjcb_control(before)
                self._before = None
        finally:
            _callback.release()
        if replaced:
            raise RuntimeError(
                "another mjcb_control was installed inside acting(), so the needles did not act after that. Install "
                "your callback before the block: it is then called as well"
            )

    def _on_control(self, model: Any, data: Any) -> None:
        if self._before is not None:
            self._before(model, data)
        if model._address == self.model._address:
            self._act(data)

    def _act(self, data: Any) -> None:
        """Applies the force of the needles, in the stage of a step at which MuJoCo calls mjcb_control."""
        needles = self._of(data)
        seen = relative(self.model, data, self._links)
        pending = needles.pending
        if pending is None or not needles.in_stage(data.time):
            needles.end_step(data.time)
            self._follows(data, needles)
            needles.pending = pending = self._tick(data, needles, seen)
            if needles.last is None:
                self._warn_behind(needles)
        needles.applied.put(data, seen.point, seen.in_world(pending.force))
        self._warn(data, needles, seen)

    def _tick(self, data: Any, needles: Needles, seen: Relative) -> Tick:
        if not self.implicit:
            nothing = np.zeros((seen.tip.size, seen.tip.size))
            return needles.ahead(data.time, seen.tip, seen, nothing)
        needles.applied.put(data, seen.point, seen.in_world(needles.force))
        free, compliance = without(self.model, data, seen, needles.force)
        if not np.isfinite(free).all():
            raise RuntimeError(
                "MuJoCo gives an acceleration that is not finite: look at data.ctrl, data.qfrc_applied and "
                "data.xfrc_applied. The needles did not move on"
            )
        return needles.ahead(data.time, free, seen, compliance)

    # State

    def save(self, data: Any) -> bytes:
        """The state of `data` and of its needles, to continue with the same bits after restore()."""
        needles = self._of(data)
        needles.applied.take_away(data)  # the next step puts it back
        return pack(self._mujoco, self.model, data, needles)

    def restore(self, data: Any, state: bytes) -> None:
        """Sets `data` and its needles to the bytes of save(). Raises ValueError, and changes nothing, for other bytes.

        Derived quantities, such as data.xpos, are those of the restored state after the next step or mj_forward.
        """
        fresh = Needles(self._links, self._timestep)
        physics = unpack(self._mujoco, self.model, state, fresh)
        self._mujoco.mj_setState(self.model, data, physics, self._mujoco.mjtState.mjSTATE_INTEGRATION)
        self._needles[data] = fresh

    def reset(self, data: Any) -> None:
        """Forgets the past of the needles of `data`, for example after mujoco.mj_resetData."""
        needles = self._needles.pop(data, None)
        if needles is not None:
            needles.applied.take_away(data)

    def detach(self) -> None:
        """Frees the model for another attach(). This Attachment cannot be used any more."""
        if self._in_use.locked():
            raise RuntimeError("leave the block of acting() before detach()")
        self._forget(self.model)
        self._links = []

    # Results

    def force(self, data: Any) -> Array:
        """(L, 3) Force on each needle in the last step, N, in the world. L: pairs of a needle and a body."""
        needles = self._of(data)
        rotation = np.array([data.xmat[link.body].reshape(3, 3) for link in self._links])
        shown = needles.pending.force if needles.pending else needles.force
        forces: Array = np.einsum("lij,lj->li", rotation, shown)
        return forces

    def last_tick(self, data: Any) -> Tick | None:
        """What the last finished step gave to the models and got from them; None before the first.

        punctura.Insertion gives the same forces for these tips, bit for bit.
        """
        return self._of(data).last

    def depths(self, data: Any) -> list[tuple[float, ...]]:
        """Depth behind each membrane, m, for each pair of a needle and a body: of the proxy, as in a tick."""
        return [insertion.depths for insertion in self._of(data).insertions]

    def phases(self, data: Any) -> list[tuple[Phase, ...]]:
        """Phase at each membrane, for each pair of a needle and a body."""
        return [insertion.phases for insertion in self._of(data).insertions]

    # Checks

    def _usable(self) -> None:
        if not self._links:
            raise RuntimeError("this Attachment was detached: attach() the needles again")
        if self.model.opt.timestep != self._timestep:
            raise RuntimeError(
                f"model.opt.timestep was {self._timestep:g} s when the needles were attached and is now "
                f"{self.model.opt.timestep:g} s: call detach(), and attach() again"
            )

    def _of(self, data: Any) -> Needles:
        self._usable()
        if data.model._address != self.model._address:
            raise ValueError("this MjData belongs to another model than the needles: attach() them to its model")
        needles = self._needles.get(data)
        if needles is None:
            needles = self._needles[data] = Needles(self._links, self._timestep)
        return needles

    def _follows(self, data: Any, needles: Needles) -> None:
        """Refuses a step that does not follow the last one."""
        if needles.last is None:
            return
        missing = data.time - needles.last.time - self._timestep
        if abs(missing) > 0.25 * self._timestep:
            raise RuntimeError(
                f"the last step of the needles began at {needles.last.time:.6g} s and data.time is now {data.time:.6g} "
                "s: data was stepped, reset or set without them (MuJoCo itself resets data that became unstable). Use "
                "step() for every step, restore() to go back, and reset() to begin anew"
            )

    def _warn_behind(self, needles: Needles) -> None:
        """Warns if a needle begins behind a membrane."""
        for link, insertion in zip(self._links, needles.insertions, strict=True):
            phases = zip(insertion.scene.membranes, insertion.phases, strict=True)
            behind = [membrane.name for membrane, phase in phases if phase == Phase.barred]
            if behind:
                warnings.warn(
                    f"site {link.needle!r} begins behind {', '.join(map(repr, behind))} and gets no force from there "
                    "until it has been in front. To continue in tissue, or in a copy of an MjData, use save() and "
                    "restore()",
                    stacklevel=3,
                )

    def _warn(self, data: Any, needles: Needles, seen: Relative) -> None:
        """Warns once a link if an explicit force cannot be stable."""
        for i, link in enumerate(self._links):
            if self.implicit or i in self._warned or not needles.holds(i):
                continue
            self._warned.add(i)
            mass = 1 / np.linalg.eigvalsh(mobility(self.model, data, seen)[3 * i : 3 * i + 3, 3 * i : 3 * i + 3])[-1]
            scene = link.insertion.scene
            text = stability_text(link.needle, mass, scene.coupling, self._timestep, len(scene.membranes))
            if text:
                warnings.warn(text, StabilityWarning, stacklevel=3)
