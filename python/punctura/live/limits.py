"""Limits files: limits of the force on a device and of its inputs. A key that is left out has its default.

max_force_N = 0.5           # of the force's norm
continuous_force_N = 0.3    # rms over continuous_time_s
dead_man_buttons = [1]      # one of them must be held for force to be given
"""

from __future__ import annotations

import math
import os
from collections.abc import Mapping
from types import MappingProxyType
from typing import NamedTuple

from punctura._core import Device, ForceLimits, GateLimits, ServoLoop, SimulatedDevice, ThumbLoop
from punctura.errors import ConfigurationError, Problem
from punctura.files.fields import Buttons, Number
from punctura.files.tables import Table, in_si, read_table
from punctura.files.units import split_key
from punctura.live.choose import gate_for

_RATED = {"max_force_N": "max_force", "continuous_force_N": "continuous_force"}  # no device gives more


class LimitsFile(Table):
    """The keys of a limits file. Their names without the unit are the fields of ForceLimits and GateLimits."""

    max_force_N: Number | None = None
    continuous_force_N: Number | None = None
    continuous_time_s: Number | None = None
    ramp_time_s: Number | None = None
    warm_motor: Number | None = None
    max_speed_m_per_s: Number | None = None
    stale_ms: Number | None = None
    deadline_ms: Number | None = None
    axis_tolerance: Number | None = None
    dead_man_buttons: Buttons | None = None

    @property
    def force(self) -> dict[str, float]:
        """The given fields of ForceLimits, SI."""
        return self._given("max_force_N", "continuous_force_N", "continuous_time_s", "ramp_time_s", "warm_motor")

    @property
    def gate(self) -> dict[str, float | int]:
        """The given fields of GateLimits, SI."""
        given: dict[str, float | int] = {}
        given |= self._given("max_speed_m_per_s", "stale_ms", "deadline_ms", "axis_tolerance")
        if self.dead_man_buttons is not None:
            given["dead_man"] = sum({1 << (number - 1) for number in self.dead_man_buttons})
        return given

    def _given(self, *keys: str) -> dict[str, float]:
        return {split_key(key)[0]: in_si(key, value) for key in keys if (value := getattr(self, key)) is not None}


class RunLimits(NamedTuple):
    """The limits of a run. gate, chosen: the fields of GateLimits and ForceLimits that the user chose, SI."""

    force: ForceLimits = ForceLimits()
    gate: Mapping[str, float | int] = MappingProxyType({})
    chosen: Mapping[str, float] = MappingProxyType({})
    source: str = ""  # the file

    def gate_on(self, device: Device) -> GateLimits:
        """The input limits for this device; fields that were not chosen are those of gate_for.

        Raises ConfigurationError if the device cannot keep to them.
        """
        made = gate_for(device).replace(**self.gate)
        info = device.info
        problems = []
        missing = [bit + 1 for bit in range(32) if made.dead_man >> bit & 1 and bit >= info.button_count]
        if missing:
            has = f"{info.model or info.backend} has {info.button_count or 'no'} button"
            plural = "" if info.button_count == 1 else "s"
            fed = "; state the number in DeviceInfo(button_count=...)" if info.backend == "fed" else ""
            problems.append(Problem("dead_man_buttons", missing, f"{has}{plural}: it can never be held{fed}"))
        for name, limit in (("stale_ms", made.stale), ("deadline_ms", made.deadline)):
            if limit < 1 / info.rate:
                reason = f"a period of {info.model or info.backend} is longer, {1e3 / info.rate:.3g} ms"
                problems.append(Problem(name, limit * 1e3, reason))
        if problems:
            raise ConfigurationError(problems, self.source)
        return made

    def at_most(self, max_force: float) -> RunLimits:
        """The same limits with another max_force, N. Raises ConfigurationError."""
        chosen = {**self.chosen, "max_force": max_force}
        return self._replace(force=self.force.replace(max_force=max_force), chosen=MappingProxyType(chosen))

    def notes(self, loop: ServoLoop, thumb: ThumbLoop | None = None) -> list[str]:
        """Warnings: a force above the device's rating, a button that nobody can press. thumb: of the second device."""
        model, notes = loop.device.info.model or loop.device.info.backend, []
        for name, field in _RATED.items():
            chosen, given = self.chosen.get(field, 0), getattr(loop.limits, field)
            if chosen > given:
                notes.append(f"{name} = {chosen:g} is above the rating of {model}: {given:g} N is the limit")
        usual, chosen = ForceLimits().continuous_time, self.force.continuous_time
        if chosen > usual:
            notes.append(
                f"continuous_time_s = {chosen:g} lets strong forces last longer than {usual:g} s does: "
                "motors may get hotter than their maker allows"
            )
        held = [one for one in (loop, thumb) if one is not None and math.isfinite(one.device.longest_silence[1])]
        longest, room = self.gate.get("deadline", 0), GateLimits().deadline
        if longest > room and held:
            notes.append(
                f"deadline_ms = {longest * 1e3:g} lets the device hold a force for longer than the long-run limit "
                f"keeps room for, {room * 1e3:g} ms. If ticks come late, the force can exceed continuous_force_N"
            )
        if self.gate.get("dead_man") and isinstance(loop.device, SimulatedDevice):
            notes.append("the simulated hand presses no button: with dead_man_buttons it is given no force")
        return notes


def load_limits(path: str | os.PathLike[str]) -> RunLimits:
    """Reads a limits file. Raises ConfigurationError with all of its problems."""
    file = read_table(
        path,
        "limits",
        LimitsFile,
        (lambda file: ForceLimits(**file.force), lambda file: GateLimits().replace(**file.gate)),
    )
    return RunLimits(ForceLimits(**file.force), file.gate, file.force, os.fspath(path))
