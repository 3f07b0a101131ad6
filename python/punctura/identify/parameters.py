"""The parameters of a trace's model: which are free, what they share, in which range they lie."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from punctura import Needle, Tissue
from punctura._core import TraceModel
from punctura.trace.rig_force import RIG_FORCES

Array = NDArray[np.float64]

MEMBRANE = TraceModel.membrane_names
COUPLING = TraceModel.coupling_names
LATE = ("lag", "delay", "play", "slack")  # s: of the force behind the depth; m: of the needle behind the drive
ZERO = ("offset", "drift", *RIG_FORCES)  # what the force of a sample has beside that of the tissue
NUISANCE = (*ZERO, *LATE)  # of the rig
LATEST = {"lag": 0.2, "delay": 0.2, "play": 1e-3, "slack": 1e-3}  # s, m: what is more is no error of a rig
UNITS = TraceModel.units | {
    "offset": "N", "drift": "N/s", "slide_friction": "N", "slide_friction_out": "N",
    "slide_friction_before": "N", "slide_way": "m",
    "cable_stiffness": "N/m", "lag": "s", "delay": "s", "play": "m", "slack": "m",
}  # fmt: skip
_LOGARITHMIC = {
    "stiffness", "friction", "thickness", "tip_length", "tail_length", "coupling_stiffness", "relaxation_1_time",
    "relaxation_2_time",
}  # fmt: skip
_RANGES = {  # of a trace of the usual scale; others have these and their own
    "stiffness": (1e-1, 1e7), "precompression": (0.0, 1e4), "friction": (1e-4, 1e2), "thickness": (1e-6, 0.3),
    "tip_length": (1e-5, 0.1), "growth": (-5e4, 5e4), "tail_length": (1e-5, 0.1), "tail_floor": (0.0, 1.0),
    "cutting": (0.0, 1e4), "set": (0.0, 0.98), "coupling_stiffness": (1.0, 1e7), "coupling_damping": (0.0, 1e3),
    "relaxation_1_stiffness": (0.0, 1e7), "relaxation_1_time": (1e-3, 1e3),
    "relaxation_2_stiffness": (0.0, 1e7), "relaxation_2_time": (1e-3, 1e4), "surface": (-1.0, 1.0),
    "lag": (0.0, LATEST["lag"]), "delay": (-LATEST["delay"], LATEST["delay"]), "play": (0.0, LATEST["play"]),
    "slack": (0.0, LATEST["slack"]), "slide_way": (-1e-3, 1e-3),  # beside the one that is subtracted
}  # fmt: skip


@dataclass(frozen=True)
class Parameters:
    """The values of all parameters, SI."""

    needle: Needle  # as it was given
    membranes: Array  # a row for each membrane, with the values of MEMBRANE
    coupling: Array  # as COUPLING
    nuisance: Array = field(default_factory=lambda: np.zeros(len(NUISANCE)))  # as NUISANCE

    def get(self, name: str) -> float:
        """The value of `membrane[0].friction`, `tissue.friction` (the first membrane's), `coupling_stiffness` ..."""
        return float(self.vector()[indices(name, len(self.membranes))[0]])

    @property
    def late(self) -> tuple[float, float, float, float]:
        """Lag and delay of the sensor, s; play of the drive that is crossed at a turn, and under another force, m."""
        lag, delay, play, slack = self.nuisance[-len(LATE) :].tolist()
        return lag, delay, play, slack

    def vector(self) -> Array:
        """All values in one vector: coupling, membranes, nuisance."""
        return np.concatenate((self.coupling, self.membranes.ravel(), self.nuisance))

    def with_vector(self, vector: Array) -> Parameters:
        """The same needle with other values."""
        m = len(self.membranes)
        first, last = len(COUPLING), len(COUPLING) + m * len(MEMBRANE)
        rows = vector[first:last].reshape(m, len(MEMBRANE)).copy()
        return Parameters(self.needle, rows, vector[:first].copy(), vector[last:].copy())

    def with_values(self, values: Mapping[str, float]) -> Parameters:
        """Some values changed, by name."""
        vector = self.vector()
        for name, value in values.items():
            vector[list(indices(name, len(self.membranes)))] = value
        return self.with_vector(vector)

    def in_order(self) -> Parameters:
        """The same walls in the order of their depth."""
        order = np.argsort(self.membranes[:, MEMBRANE.index("surface")], kind="stable")
        return replace(self, membranes=self.membranes[order])


def default_membrane() -> Array:
    """A membrane of K06 without values: every extension is off."""
    return np.array([getattr(Tissue(), name, 0.0) for name in MEMBRANE])


def default_coupling(stiffness: float) -> Array:
    """A spring alone; the time constants of the relaxation are those of an absent branch."""
    values = dict.fromkeys(COUPLING, 0.0)
    values |= {"coupling_stiffness": stiffness, "relaxation_1_time": 1.0, "relaxation_2_time": 10.0}
    return np.array([values[name] for name in COUPLING])


def indices(name: str, membranes: int) -> tuple[int, ...]:
    """Where a parameter stands in the vector. `tissue.friction` stands in every membrane. Raises KeyError."""
    if name in COUPLING:
        return (COUPLING.index(name),)
    if name in NUISANCE:
        return (len(COUPLING) + membranes * len(MEMBRANE) + NUISANCE.index(name),)
    owner, _, kind = name.partition(".")
    if kind in MEMBRANE:
        at = [len(COUPLING) + i * len(MEMBRANE) + MEMBRANE.index(kind) for i in range(membranes)]
        if owner == "tissue":
            return tuple(at)
        if owner.startswith("membrane[") and owner[9:-1].isdigit() and int(owner[9:-1]) < membranes:
            return (at[int(owner[9:-1])],)
    raise KeyError(f"no parameter {name}")


def kind_of(name: str) -> str:
    """`friction` of `membrane[0].friction` and of `tissue.friction`."""
    return name.rpartition(".")[2]


def _unit(kind: str, scale: tuple[float, float]) -> float:
    """What a kind of parameter is multiplied by where force and depth are larger by these factors."""
    force, depth = scale
    stiffness = force / depth
    units = {"N": force, "N/s": force, "m": depth, "1/m": 1 / depth, "N/m": stiffness, "N s/m": stiffness}
    return units.get(UNITS[kind], 1.0)


class Free:
    """The free parameters of a fit, and their coordinates u.

    A coordinate is a logarithm where a parameter is positive by nature. The coordinate of a free surface is the depth
    where its wall pops: the pop is seen sharply, so a search must be able to change all else without moving it. A wall
    that pops deeper than the trace goes has its surface itself as coordinate: there the contact is what is seen.
    Behind a delay, a pop is seen deeper.
    """

    def __init__(
        self,
        names: Sequence[str],
        base: Parameters,
        deepest: float = np.inf,
        zero: tuple[float, float] = (-np.inf, np.inf),
        speed: Callable[[float], float] = lambda _: 0.0,
        scale: tuple[float, float] = (1.0, 1.0),
    ) -> None:
        """base: gives all other values, and says which walls pop. deepest: the greatest depth of the trace, m.

        zero: the range of the offset, N, if no drift is free. speed: m/s, at which the needle comes to a depth, m.
        scale: of force and depth (Trace.scale). Bounds become wider by it, never narrower.
        """
        self.names = tuple(names)
        self._zero = (-np.inf, np.inf) if "drift" in self.names else zero
        self._scale = scale
        self.base = base
        m = len(base.membranes)
        self._at = [np.array(indices(name, m)) for name in self.names]
        self._log = np.array([kind_of(name) in _LOGARITHMIC for name in self.names])
        units = [1.0 if log else _unit(kind_of(name), scale) for name, log in zip(self.names, self._log, strict=True)]
        self.units = np.array(units)  # of the coordinates (p,): what a step is compared with
        self._rows = np.concatenate([*self._at, np.zeros(0, int)]).astype(int)  # in the vector, and whose they are:
        self._owner = np.repeat(np.arange(len(self.names)), [len(at) for at in self._at])
        self.kinds = [kind for kind in (*COUPLING, *MEMBRANE) if kind in map(kind_of, self.names)]
        self.late = [kind for kind in LATE if kind in self.names]
        self._last: tuple[bytes, Array] | None = None  # coordinates, and the vector of all parameters
        low, high = np.array([self._range(name) for name in self.names]).reshape(-1, 2).T
        self._least, self._most = low, high
        self.low, self.high = self._coordinates(low), self._coordinates(high)
        surfaces = [indices(f"membrane[{i}].surface", m)[0] for i in range(m)]
        vector = base.vector()
        pops = self._pops(vector, False)[0] if np.isfinite(deepest) else np.zeros(m)
        # each free surface whose pop is seen: its coordinate, and its membrane
        self.walls = [
            (k, surfaces.index(at[0]))
            for k, at in enumerate(self._at)
            if at[0] in surfaces and pops[surfaces.index(at[0])] <= deepest - vector[at[0]]
        ]
        self._delay = indices("delay", m)[0]
        self._speeds = {wall: speed(float(vector[surfaces[wall]] + pops[wall])) for _, wall in self.walls}

    def _range(self, name: str) -> tuple[float, float]:
        kind = kind_of(name)
        if kind == "friction":  # insertion needs mu tan(theta) < 1, K06 (7)
            return 1e-4, 0.98 / float(np.tan(self.base.needle.tip_angle))
        if kind == "offset":
            return self._zero
        low, high = _RANGES.get(kind, (-np.inf, np.inf))
        unit = 1.0 if kind in LATE else _unit(kind, self._scale)
        return min(low, low * unit), max(high, high * unit)

    def _coordinates(self, values: Array) -> Array:
        return np.where(self._log, np.log(np.where(self._log, values, 1.0)), values)

    def coordinates(self, parameters: Parameters) -> Array:
        """The coordinates of the free parameters, moved into their ranges."""
        vector = parameters.vector()
        values = np.array([vector[at[0]] for at in self._at])
        values = np.where(self._log, np.maximum(values, self._least), values)
        u = np.clip(self._coordinates(values), self.low, self.high)
        if self.walls:
            pops, _ = self._pops(self._without_pops(u), False)
            for k, wall in self.walls:
                u[k] += pops[wall] + self._speeds[wall] * parameters.late[1]
        return np.clip(u, self.low, self.high)

    def _without_pops(self, u: Array) -> Array:
        """The vector of all parameters for these coordinates, if those of the surfaces were the surfaces."""
        vector = self.base.vector()
        # exp(log(bound)) may lie behind the bound by a rounding error, and then no scene takes the value
        values = np.where(self._log, np.clip(np.exp(np.where(self._log, u, 0.0)), self._least, self._most), u)
        vector[self._rows] = values[self._owner]
        return vector

    def _pops(self, vector: Array, jacobian: bool) -> tuple[Array, Array]:
        p = self.base.with_vector(vector)
        return TraceModel.pop_depths(p.needle, p.membranes, p.coupling, jacobian=jacobian)

    def parameters(self, u: Array) -> Parameters:
        """All parameters for these coordinates. A search asks twice in turn: for the residuals and the derivatives."""
        asked = u.tobytes()
        if self._last is None or self._last[0] != asked:
            vector = self._without_pops(u)
            if self.walls:
                pops, _ = self._pops(vector, False)
                for k, wall in self.walls:
                    vector[self._at[k]] -= pops[wall] + self._speeds[wall] * vector[self._delay]
            self._last = asked, vector
        return self.base.with_vector(self._last[1])

    def place(self, j: int) -> int:
        """Where parameter j first stands in the vector of all parameters."""
        return int(self._at[j][0])

    def logarithmic(self, j: int) -> bool:
        """Whether coordinate j is a logarithm."""
        return bool(self._log[j])

    def values(self, u: Array) -> Array:
        """The values of the free parameters, SI."""
        vector = self.parameters(u).vector()
        return np.array([vector[at[0]] for at in self._at])

    def derivatives(self, u: Array) -> Array:
        """Derivatives of the vector of all parameters by the coordinates: (parameters, free)."""
        vector = self._without_pops(u)
        by_u = np.zeros((len(vector), len(u)))
        by_u[self._rows, self._owner] = np.where(self._log[self._owner], vector[self._rows], 1.0)
        if self.walls:
            _, rows = self._pops(vector, True)
            shared, own = len(COUPLING), len(MEMBRANE)
            for k, wall in self.walls:
                first = shared + wall * own
                moves = rows[wall, :shared] @ by_u[:shared] + rows[wall, shared + 1 :] @ by_u[first + 1 : first + own]
                by_u[self._at[k][0]] -= moves + self._speeds[wall] * by_u[self._delay]
        return by_u
