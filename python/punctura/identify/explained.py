"""Whether the model explains the trace: what is left beside the noise in air, and where."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from punctura.identify.air_noise import AirNoise
from punctura.identify.fit import Fit
from punctura.identify.growing_noise import grown
from punctura.identify.noise import effective_samples
from punctura.trace import Segments, Trace
from punctura.trace.ends import without_zero
from punctura.trace.steps import rounding
from punctura.trace.turns import noise_of

Array = NDArray[np.float64]

BLOCKS, SHORTEST = 150, 5  # blocks in tissue, about; samples of a block, at least
MEDIAN = np.pi / 2  # the variance of a median of n samples of noise, in those of their mean
SURE = 4.0  # standard deviations of chance
MATTERS = 0.01  # of the greatest force: less is no misfit that a reader needs to know
SEEN = 0.002  # of the greatest force: no sensor is better, so less tells nothing of the law
CLEAR = 0.5  # of the noise of a block: less does not show in the trace
NAMED = 3  # places in a sentence


@dataclass(frozen=True)
class Place:
    """Where the model is wrong: a stretch of a stroke. SI."""

    kind: str  # in, out, hold
    insertion: int
    start: int  # samples
    end: int  # exclusive
    shallow: float  # m
    deep: float  # m
    force: float  # N, measured less computed, in the middle
    share: float  # of all that is not explained

    def __str__(self) -> str:
        way = {"in": "on the way in", "out": "on the way out", "hold": "at rest"}[self.kind]
        again = "" if self.insertion == 0 else f" of insertion {self.insertion + 1}"
        where = f"from {self.shallow * 1e3:.4g} to {self.deep * 1e3:.4g} mm"
        where = f"at {self.deep * 1e3:.4g} mm" if self.kind == "hold" else where
        return f"{way}{again} {where} the measured force is {abs(self.force):.2g} N " + (
            "above the model's" if self.force > 0 else "below the model's"
        )


@dataclass(frozen=True, eq=False)
class Blocks:
    """Medians of neighbouring residuals in tissue, measured less computed. edges (b, 2): samples, end exclusive."""

    edges: NDArray[np.int64]
    strokes: NDArray[np.int64]  # (b,) number of the stroke
    left: Array  # (b,), N, over `times`
    times: Array  # (b,) how many times the noise in air that in the block is
    noise: float  # N, standard deviation of such a median of noise alone


@dataclass(frozen=True, eq=False)
class Explained:
    """How well a fit explains its trace. SI."""

    noise: float  # N, of a sample in air, or from sample to sample if there is no air
    air: bool  # whether there is air
    left: float  # N, what is left in tissue beyond this noise, smoothed
    peak: float  # N
    runs: int  # stretches of residuals of one sign
    runs_of_noise: float  # how many noise would have
    effective_samples: float
    samples: int
    parameters: int
    places: tuple[Place, ...]  # the largest first; empty if the trace is explained
    blocks: Blocks
    tested: bool  # whether there are more blocks than parameters
    beaten: bool  # less is left than matters, but a force that follows the depth freely is clearly better

    @property
    def ok(self) -> bool:
        """Whether nothing is left that is both beyond chance and large enough to matter."""
        return not self.places

    @property
    def whole(self) -> bool:
        """Whether no law of the depth can be clearly better: the blocks are the best one for each stroke.

        False where the trace is too short to tell.
        """
        return self.ok and self.tested and not self.beaten

    def sentence(self) -> str:
        """What is not explained, and where; empty if the trace is explained."""
        if self.whole:
            return ""
        if self.ok and not self.tested:
            return (
                f"It cannot be tested whether the model explains the trace: the {self.samples} samples are only "
                f"{len(self.blocks.left)} stretches in tissue, and the model has {self.parameters} parameters, so it "
                "may fit whatever was measured. Record more samples, or state the number of walls (--membranes)."
            )
        if self.ok:
            return (
                f"The model does not explain all: it leaves {self.left:.2g} N beyond chance, "
                f"{100 * self.left / self.peak:.2g} % of the greatest force, and a force that follows the depth freely "
                "does not. Another law (punctura rivals) or an error of the rig may explain the trace better, and the "
                "intervals may be too narrow."
            )
        beside = f"beside a noise of {self.noise:.2g} N " + ("in air" if self.air else "from sample to sample")
        more = f"; and {len(self.places) - NAMED} smaller places" if len(self.places) > NAMED else ""
        return (
            f"The model does not explain the trace: {self.left:.2g} N are left, {100 * self.left / self.peak:.2g} % of "
            f"the greatest force, {beside}. The residuals have {self.runs} runs of one sign, and noise would have "
            f"{self.runs_of_noise:.0f}. Not explained: {'; '.join(map(str, self.places[:NAMED]))}{more}. The intervals "
            "do not hold."
        )


def explained(trace: Trace, segments: Segments, fit: Fit, air_noise: AirNoise | None = None) -> Explained:
    """Compares the residuals of a fit of all samples with the noise. Where that grows with the force, they count less.

    air_noise: of the same samples. Slow noise that it shows may be in tissue, too.
    """
    times = grown(trace, segments, fit)
    residuals = (trace.force - fit.misfit.forces(fit.parameters)) / times
    air = in_air(trace, segments, fit)
    calm = (trace.force - fit.misfit.of_rig(fit.parameters))[air]
    if without_zero(trace):  # each end has a level of its own
        parts = np.split(calm, np.flatnonzero(np.diff(np.flatnonzero(air)) > 1) + 1)
        calm = np.concatenate([part - np.median(part) for part in parts if len(part)] or [calm])
    noise = float(np.std(calm)) if len(calm) >= SHORTEST else noise_of(trace.force)
    peak = float(np.max(np.abs(trace.force)))
    slow, likely = fit.noise.slow_and_white()[0], fit.noise.most_likely()
    shown = air_noise is not None and air_noise.shows(*likely)
    allowed = air_noise is not None and air_noise.allows(*likely)
    blocks = _blocks(
        trace, segments, fit, residuals, times, calm, max(noise, noise_of(residuals)), slow if shown else 0.0
    )
    signs = residuals[residuals != 0] > 0
    up, n = int(signs.sum()), max(len(signs), 1)
    squares = float(np.mean(blocks.left**2)) if len(blocks.left) else 0.0
    beyond = blocks.times**2 * (blocks.left**2 - blocks.noise**2)
    left = float(np.sqrt(max(float(np.mean(beyond)), 0.0))) if len(beyond) else 0.0
    sure = squares > blocks.noise**2 * (1 + SURE * np.sqrt(2 / max(len(blocks.left), 1)))
    clear = left > max(MATTERS * peak, CLEAR * blocks.noise)
    places = tuple(_places(trace, segments, blocks, peak)) if sure and clear else ()
    least = max(SEEN * peak, CLEAR * blocks.noise, slow if allowed else 0.0)
    return Explained(
        noise, len(calm) >= SHORTEST, left, peak, 1 + int(np.sum(signs[1:] != signs[:-1])),
        1 + 2 * up * (n - up) / n, effective_samples(residuals, len(fit.u)), len(trace),
        len(fit.u), places, blocks, len(blocks.left) > len(fit.u), not places and sure and left > least,
    )  # fmt: skip


def in_air(trace: Trace, segments: Segments, fit: Fit) -> NDArray[np.bool_]:
    """The samples in air, well away from the tissue (n,): before the contact, and behind the last way out."""
    air = np.zeros(len(trace), bool)
    surface = _surface(trace, segments, fit)
    outside = trace.depth < surface
    air[: int(0.8 * np.argmin(outside))] = True
    last = len(trace) - int(np.argmin(outside[::-1]))  # the first sample of the air at the end
    if segments.strokes and segments.strokes[-1].kind == "out":
        air[last + (len(trace) - last) // 2 :] = True
    return air


def _surface(trace: Trace, segments: Segments, fit: Fit) -> float:
    """Where the tissue begins, m: by the trace or by the model, whichever is shallower; a bad fit is far outside."""
    model = float(fit.parameters.membranes[:, 0].min())
    known = segments.exit if segments.contact is None else segments.contact
    if known is None:
        return model
    seen, shallowest = float(trace.depth[known]), float(trace.depth[0 if known == segments.contact else -1])
    return min(model, seen) if model > shallowest else seen


def _blocks(
    trace: Trace,
    segments: Segments,
    fit: Fit,
    residuals: Array,
    times: Array,
    calm: Array,
    noise: float,
    slow: float,
) -> Blocks:
    inside = trace.depth > _surface(trace, segments, fit)
    length = max(SHORTEST, int(inside.sum()) // BLOCKS)
    edges, owners = [], []
    for number, stroke in enumerate(segments.strokes):
        rows = np.flatnonzero(inside[stroke.start : stroke.end]) + stroke.start
        for start in range(0, len(rows) - length + 1, length):
            edges.append((int(rows[start]), int(rows[start + length - 1]) + 1))
            owners.append(number)
    left = np.array([float(np.median(residuals[start:end])) for start, end in edges])
    spread = MEDIAN * noise**2 / length + slow**2
    if len(calm) >= 4 * length:
        medians = np.median(calm[: len(calm) // length * length].reshape(-1, length), axis=1)
        spread = max(spread, float(np.var(medians)))
    coarse = rounding(trace.force)  # a sensor that is quieter than its steps gives equal readings, with one error
    spread = max(spread, coarse**2) if noise < 2 * coarse else spread
    grew = np.array([float(np.median(times[start:end])) for start, end in edges])
    return Blocks(
        np.array(edges, np.int64).reshape(-1, 2), np.array(owners, np.int64), left, grew, float(np.sqrt(spread))
    )


def _places(trace: Trace, segments: Segments, blocks: Blocks, peak: float) -> list[Place]:
    """Neighbouring blocks of one stroke that are wrong in the same direction, the largest first."""
    wrong = np.abs(blocks.left) > np.maximum(SURE * blocks.noise, MATTERS * peak / blocks.times)
    label = np.where(wrong, np.sign(blocks.left), 0.0)
    total = max(float(np.sum(blocks.left**2)), 1e-300)
    found = []
    for first, last in _stretches(label, blocks.strokes):
        part = slice(first, last)
        stroke = segments.strokes[int(blocks.strokes[first])]
        start, end = int(blocks.edges[first, 0]), int(blocks.edges[last - 1, 1])
        depth = trace.depth[start:end]
        share = float(np.sum(blocks.left[part] ** 2)) / total
        found.append(
            Place(stroke.kind, stroke.insertion, start, end, float(depth.min()), float(depth.max()),
                  float(np.median(blocks.times[part] * blocks.left[part])), share)
        )  # fmt: skip
    return sorted(found, key=lambda place: -place.share)


def _stretches(label: Array, strokes: NDArray[np.int64]) -> Iterator[tuple[int, int]]:
    """First and last (exclusive) block of each stretch of one label that is not 0, within a stroke."""
    start = 0
    for i in range(1, len(label) + 1):
        if i == len(label) or label[i] != label[start] or strokes[i] != strokes[start]:
            if label[start] != 0:
                yield start, i
            start = i
