"""Limits files: what bounds the force on a device, and what its readings must fulfil. What is left out is default.

max_force_N = 0.5           # of the force's norm
continuous_force_N = 0.3    # rms over continuous_time_s
dead_man_buttons = [1]      # one of them must be held for force to be given
"""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any, NamedTuple

from punctura._core import Device, ForceLimits, GateLimits, ServoLoop, SimulatedDevice
from punctura.errors import ConfigurationError, Problem
from punctura.live.choose import gate_for
from punctura.live.tables import Buttons, Number, read_table

FORCE: dict[str, Number | Buttons] = {
    "max_force_N": Number("max_force"),
    "continuous_force_N": Number("continuous_force"),
    "continuous_time_s": Number("continuous_time"),
    "ramp_time_s": Number("ramp_time"),
    "warm_motor": Number("warm_motor"),
}
_RATED = {name: FORCE[name].field for name in ("max_force_N", "continuous_force_N")}  # no device gives more
GATE: dict[str, Number | Buttons] = {
    "max_speed_m_per_s": Number("max_speed"),
    "stale_ms": Number("stale", 1000),
    "deadline_ms": Number("deadline", 1000),
    "axis_tolerance": Number("axis_tolerance"),
    "dead_man_buttons": Buttons("dead_man"),
}


class Limits(NamedTuple):
    """force: what bounds the force. gate, chosen: those fields of GateLimits and ForceLimits that were chosen, SI."""

    force: ForceLimits = ForceLimits()
    gate: Mapping[str, Any] = MappingProxyType({})
    chosen: Mapping[str, float] = MappingProxyType({})

    def gate_on(self, device: Device) -> GateLimits:
        """What was not chosen is as gate_for has it. Raises ConfigurationError where the device cannot keep to it."""
        made = gate_for(device).replace(**self.gate)
        info = device.info
        problems = []
        missing = [bit + 1 for bit in range(32) if made.dead_man >> bit & 1 and bit >= info.button_count]
        if missing:
            has = f"{info.model or info.backend} has {info.button_count or 'no'} button"
            plural = "" if info.button_count == 1 else "s"
            problems.append(Problem("dead_man_buttons", missing, f"{has}{plural}: it can never be held"))
        for name, limit in (("stale_ms", made.stale), ("deadline_ms", made.deadline)):
            if limit < 1 / info.rate:
                reason = f"a period of {info.model or info.backend} is longer, {1e3 / info.rate:.3g} ms"
                problems.append(Problem(name, limit * 1e3, reason))
        if problems:
            raise ConfigurationError(problems)
        return made

    def at_most(self, max_force: float) -> Limits:
        """With this greatest norm of the force, N. Raises ConfigurationError."""
        chosen = {**self.chosen, "max_force": max_force}
        return self._replace(force=self.force.replace(max_force=max_force), chosen=MappingProxyType(chosen))

    def notes(self, loop: ServoLoop) -> list[str]:
        """What will not be as chosen: a force above the device's rating, a button that nobody can press."""
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
        if self.gate.get("dead_man") and isinstance(loop.device, SimulatedDevice):
            notes.append("the simulated hand presses no button: with dead_man_buttons it is given no force")
        return notes


def load_limits(path: str | os.PathLike[str]) -> Limits:
    """Reads a limits file. Raises ConfigurationError with all of its problems."""
    table = read_table(path, "limits", FORCE | GATE, _refused)
    force = _fields(FORCE, table)
    return Limits(ForceLimits(**force), _fields(GATE, table), force)


def _fields(keys: Mapping[str, Number | Buttons], table: dict[str, Any]) -> dict[str, Any]:
    return {key.field: _si(key, table[name]) for name, key in keys.items() if name in table}


def _refused(table: dict[str, Any]) -> list[Problem]:
    """What the core has against the values, told of the file's own keys."""
    problems = []
    kinds: tuple[tuple[Callable[..., object], Mapping[str, Number | Buttons]], ...] = (
        (ForceLimits, FORCE),
        (GateLimits, GATE),
    )
    for kind, keys in kinds:
        try:
            kind(**_fields(keys, table))
        except ConfigurationError as error:
            names = {key.field: name for name, key in keys.items()}
            for problem in error.problems:
                name = names[problem.path.rpartition(".")[2]]
                problems.append(Problem(name, table[name], problem.reason))
    return problems


def _si(key: Number | Buttons, value: Any) -> Any:
    if isinstance(key, Buttons):
        return sum({1 << (number - 1) for number in value})
    return float(value) / key.per_si
