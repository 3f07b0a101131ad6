"""What is wrong with the samples themselves: no reading, no motion, no force, gaps, spikes, a force that is cut off."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from punctura.trace.air import baseline, smooth
from punctura.trace.segment import Segments
from punctura.trace.steps import DIGITS, OFF, equal_runs, rounding
from punctura.trace.trace import Finding, Trace
from punctura.trace.turns import noise_of

Array = NDArray[Any]

FEW = 0.05  # of the samples: so many spikes may be left out
PULL, FINE = 3.0, 0.03  # times the noise, and of the range of the force: the air is so far above the floor
AIR, SHORTEST = 40, 20  # samples of air that tell a filter, and changes of one part of it
REPEATED, STILL, UNLIKE = 0.1, 0.15, 0.2  # of the samples, that repeat the one before; in one run; of changes
NEXT, REVERSE, CHANCE = 0.15, 0.25, 3.3  # correlations of changes that a filter makes; standard deviations of chance
BEYOND = -0.1  # the least one behind changes that are alike: what a filter has taken comes back, a slow force does not
NEAR = 8  # lags, at which the correlations are compared with that of the first one
ALIKE, HUM = 0.8, 0.5  # correlations that only a hum makes: the reverse, and once more
ROUGH, TOO_ROUGH = 0.05, 1 / 3  # of the range of the force, is a step that is named; one that shows no rise
READINGS, COARSE, MOST = 20, 0.005, 0.9  # held readings, share of the range that is no fine step, share of them


FAR = 20.0  # times the range of all other values: no tissue and no motion makes such a value


def no_reading(values: Array) -> Array:
    """Where a column (n,) holds a number that means "no reading", such as -9999: far outside all others; (n,) bool."""
    found = np.zeros(len(values), bool)
    for _ in range(2):  # perhaps one such number on each side
        for far in (np.max, np.min):
            rest = values[np.isfinite(values) & ~found]
            end = far(rest) if len(rest) else np.nan
            others = rest[rest != end]
            if len(others) < max(20, len(values) / 2):
                continue
            if float(np.min(np.abs(others - end))) > FAR * float(np.ptp(others)) > 0:
                found |= values == end
    return found


def nothing_seen(trace: Trace) -> tuple[Finding, ...]:
    """A depth or a force that is only noise: no model can be fitted. Empty for one that is the same in every sample."""
    if np.ptp(trace.depth) == 0 or np.ptp(trace.force) == 0:
        return ()
    found = []
    if float(np.ptp(trace.depth)) <= 8 * noise_of(trace.depth):
        text = "the needle does not move; record an insertion, or choose another column for the depth"
        found.append(Finding("no_motion", text, severe=True))
    width = max(1, len(trace) // 100) | 1
    noise = noise_of(trace.force)
    if float(np.ptp(smooth(trace.force, width))) <= 7 * noise / np.sqrt(width):
        text = f"the force does not change by more than its noise, {noise:.2g} N"
        found.append(Finding("no_force", f"{text}; insert deeper, or choose another column for the force", severe=True))
    return tuple(found)


def without_spikes(trace: Trace) -> tuple[Trace, list[Finding]]:
    """The trace without single samples that no tissue makes, and what is said of them."""
    force = trace.force
    rise, fall = force[1:-1] - force[:-2], force[1:-1] - force[2:]
    alone = np.where((rise > 0) == (fall > 0), np.minimum(np.abs(rise), np.abs(fall)), 0.0)
    usual = float(np.subtract(*np.percentile(force, (95, 5))))
    spikes = np.flatnonzero(alone > max(0.5 * usual, 12 * noise_of(force))) + 1
    if not len(spikes):
        return trace, []
    text = f"samples that stand out from both neighbours: {len(spikes)}, by up to {alone.max():.3g} N"
    text += f"; the first is sample {int(spikes[0]) + 1}"
    if len(spikes) > FEW * len(trace):
        return trace, [Finding("spikes", f"{text}. Look for a loose contact, or choose another column for the force")]
    kept = np.delete(np.arange(len(trace)), spikes)
    return trace[kept], [Finding("spikes", f"{text}; they are left out", True)]


def with_depth_between(trace: Trace) -> tuple[Trace, list[Finding]]:
    """The trace with the depth on straight lines between the readings of a slower sensor, whose value was held.

    Such readings stand for a fixed number of samples each. So does a fine step at one speed; it is no held reading.
    """
    runs = equal_runs(trace.depth)
    lengths, steps = np.diff(runs), np.abs(np.diff(trace.depth[runs[:-1]]))
    held = int(np.median(lengths))
    if trace.time is None or held < 2 or len(steps) < READINGS:
        return trace, []
    usual = float(np.median(steps))
    fine = usual < COARSE * float(np.ptp(trace.depth)) and np.mean(np.abs(steps / usual - 1) < OFF) > MOST
    if fine or np.mean(np.abs(lengths - held) <= 1) < MOST:
        return trace, []
    fresh = np.concatenate([np.arange(start, end, held) for start, end in pairwise(runs)])
    between = np.interp(trace.time, trace.time[fresh], trace.depth[fresh])
    text = f"the depth has a new value only in every {held}th sample; between them it is taken on straight lines"
    return replace(trace, depth=between), [Finding("depth_held", text, True)]


def gaps(trace: Trace) -> Iterator[Finding]:
    """Stretches without samples."""
    if trace.time is not None:
        steps = np.diff(trace.time)
        if steps.max() > max(20 * float(np.median(steps)), 5e-3 * float(np.ptp(trace.time))):
            text = f"no samples for {steps.max():.3g} s behind sample {int(np.argmax(steps)) + 1}"
            yield Finding("gap", f"{text}; what the needle did there is not known, so the fit can be wrong")


def coarse_force(trace: Trace) -> Iterator[Finding]:
    """Steps of the force that are large beside its range, as of a file in kN with few digits."""
    step, height = float(np.sqrt(12)) * rounding(trace.force), float(np.ptp(trace.force))
    if step > ROUGH * height:
        text = f"the force is given in steps of {step:.2g} N, and its range is {height:.2g} N: what lies between is not"
        advice = "known. Export it with more digits or in a smaller unit, or take a finer sensor"
        yield Finding("coarse_force", f"{text} {advice}", severe=step >= TOO_ROUGH * height)


def smeared(*air: Array) -> int:
    """Over how many samples a program has smoothed or filled in the force, as its noise in air (n,), N, shows; or 0.

    air: before the tissue and behind it. Slow noise of a sensor is alike in neighbouring samples, too, but its changes
    from sample to sample are not. A filter makes changes that are like the next ones, or, a mean of k samples, the
    reverse of those k samples before. A median, and a reading that is held, repeat it.
    """
    air = tuple(one for one in air if len(one) > SHORTEST)
    parts = [_without_bend(np.diff(one)) for one in air]
    count = sum(map(len, parts))
    if count < AIR - 1:
        return 0
    most = min(min(map(len, parts)) // 2, count // 5)
    alike = _alike(parts, most)
    if not alike[0] > 0:
        return 0
    chance, width = CHANCE / np.sqrt(count), int(np.argmin(alike))
    hum = float(alike[int(np.argmax(alike <= 0)) :].max()) > HUM or alike[width] < -ALIKE
    reverse = alike[width] < -max(REVERSE, chance) and alike[1] > -NEXT
    smooth = (alike[1] > max(NEXT, chance) and alike[width] < BEYOND) or reverse
    if width > 1 and smooth and not hum and not _white_beside(alike[1:width], chance):
        return width
    if not _repeated(np.concatenate(air)):
        return 0
    gone = _alike([_without_bend(one) for one in air], most) <= 0
    return int(np.argmax(gone)) if gone.any() else most


def _alike(parts: Sequence[Array], most: int) -> Array:
    """The correlation of values with those up to `most` samples behind, over all parts; the first is 1, or 0."""
    spectra = [np.fft.rfft(one, 2 * len(one)) for one in parts]  # with zeros behind: no end meets the beginning
    alike = np.sum([np.fft.irfft(np.abs(one) ** 2)[: most + 1] for one in spectra], axis=0)
    return np.asarray(alike / alike[0]) if alike[0] > 0 else alike


def _white_beside(alike: Array, chance: float) -> bool:
    """Whether white noise is left beside a slow change, so that changes are less like the next ones than like others.

    alike: the correlations of changes at lags 1, 2 ..., within the width of a filter, which would leave no white noise.
    """
    later = alike[1:NEAR]
    if not len(later):
        return False
    return bool(later.mean() - alike[0] > max(NEXT, chance * np.sqrt(1 + 1 / len(later))))


def _repeated(air: Array) -> bool:
    """Whether noise (n,) stands still from sample to sample, as a median or a hold makes it, and not its steps.

    Changes by steps are alike, also beside a force of the rig that was subtracted. A force without noise stands still
    for long.
    """
    lengths, changes = np.diff(equal_runs(air)), np.abs(np.diff(air))
    moved, still = changes[changes > 0], air[1:][changes == 0]
    if len(moved) > (1 - REPEATED) * len(changes) or int(lengths.max()) > STILL * len(air):
        return False
    if len(np.unique(still)) < UNLIKE * len(still):  # of a sensor that shows no pull
        return False
    values = len(np.unique(np.round(moved / (DIGITS * float(moved.max())))))
    return values > UNLIKE * len(moved) and rounding(air) == 0


def _without_bend(values: Array) -> Array:
    """What a parabola leaves of the values (n,): a soft layer bends the force in air."""
    powers = np.vander(np.linspace(-1, 1, len(values)), 3)
    return np.asarray(values - powers @ np.linalg.lstsq(powers, values, rcond=None)[0])


def smoothed(*air: Array) -> Iterator[Finding]:
    """A force that a program has smoothed: a filter smears pops as well."""
    if width := smeared(*air):
        text = f"the noise in air is alike in some {width} neighbouring samples, as if the force was smoothed or filled"
        advice = "pops are then smeared as well, and look like other walls. Export it as it is measured"
        yield Finding("smoothed", f"{text} in: {advice}")


def without_floor(trace: Trace, segments: Segments) -> tuple[Trace, list[Finding]]:
    """The trace without the ways out on which the force stands at its zero, as where a sensor measures no pull."""
    force, zero = trace.force, baseline(trace.force)
    if zero - force.min() > 0.1 * float(np.max(np.abs(force - zero))):
        return trace, []
    air = force[:0] if segments.exit is None else force[segments.exit :]
    if len(air) and float(np.median(air)) - force.min() > max(PULL * noise_of(force), FINE * float(np.ptp(force))):
        return trace, []  # in air the sensor reads more, so it measures a pull
    surface = trace.depth.min() if segments.contact is None else trace.depth[segments.contact]
    floor, left_out = (force == force.min()) & (trace.depth > surface), np.zeros(len(force), bool)
    for stroke in segments.strokes:
        begin = stroke.start + int(np.argmax(floor[stroke.start : stroke.end]))
        end = begin + int((trace.depth[begin : stroke.end] > surface).sum())
        if stroke.kind == "out" and floor[begin:end].sum() > max(SHORTEST, 0.5 * (end - begin)):
            left_out[begin:end] = True
    if not left_out.any():
        return trace, []
    text = f"the force stands at {force.min():.3g} N for {int(left_out.sum())} samples while the needle goes out"
    advice = "perhaps the sensor measures no pull; they are left out. Take a sensor that does"
    return trace[~left_out], [Finding("no_pull", f"{text}: {advice}", True)]


def without_cut_off(trace: Trace) -> tuple[Trace, list[Finding]]:
    """The trace without the samples where the force stands at its greatest or least value, while it moves elsewhere.

    The sensor's range ends there. The other values are compared, too: a sensor of coarse steps or a slow one repeats
    all of its values.
    """
    force = trace.force
    runs = equal_runs(force)
    starts, lengths = runs[:-1], np.diff(runs)
    values, zero = force[starts], baseline(force)
    height = float(np.max(np.abs(force - zero)))
    ends = [end for end in (float(force.max()), float(force.min())) if abs(end - zero) > 0.1 * height]
    usual = int(lengths[~np.isin(values, ends)].max(initial=1))
    found, kept = [], np.ones(len(force), bool)
    for end in ends:
        longest = int(lengths[values == end].max())
        if longest >= 5 and longest > 3 * usual:
            first = int(starts[(values == end) & (lengths == longest)][0]) + 1
            text = f"the force stands at {end:.4g} N for {longest} samples, from sample {first} on, and goes no further"
            advice = "what it was there is not known, so these samples are left out. Take a sensor of a larger range"
            limit = "perhaps the sensor or its amplifier is at its limit"
            kept &= force != end
            found.append(Finding("cut_off", f"{text}: {limit}; {advice}", True))
    return (trace[kept] if kept.sum() >= 5 else trace), found
