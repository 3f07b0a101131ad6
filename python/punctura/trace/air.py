"""The air before the tissue and behind it: it tells the contact, the zero of the force, and whether the zero drifted.

Contact is the first departure of the force from the air, also if a soft layer resists before a firm wall.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from punctura.trace.steps import DIGITS, rounding
from punctura.trace.turns import noise_of

Array = NDArray[np.float64]

FEWEST = 5  # samples of air
LASTS = 3  # samples, that a departure lasts at least
NOISES, SHARE = 8.0, 0.03  # a departure is larger than so many times the noise, and this share of the greatest force
FIRM = 0.5  # of the greatest force: so much only tissue resists
NEAR = 0.02  # of the range of the depths
STEEP, SURE = 0.5, 3.0  # of the slope behind the contact, and so many errors: in air the force rises by less
MANY, SHAPED, FINER = 20, 1.5, 4.0  # samples of air; times the noise; a part of the threshold before
AROUND = 5  # times the samples of the first rise: the samples before it in which the contact is looked for


def smooth(values: Array, width: int) -> Array:
    """Moving average over an odd number of samples. Both ends repeat their last value."""
    half = max(width // 2, 0)
    if half == 0:
        return values
    padded = np.concatenate((np.full(half, values[0]), values, np.full(half, values[-1])))
    total = np.concatenate(([0.0], np.cumsum(padded)))
    return np.asarray((total[2 * half + 1 :] - total[: -2 * half - 1]) / (2 * half + 1))


def baseline(force: Array) -> float:
    """The force before contact, N: the median of the first samples."""
    return float(np.median(force[: _first(force)]))


def above_air(force: Array) -> Array:
    """The force (n,) less its zero before contact, N, averaged over half a per cent of the samples."""
    return smooth(force, max(1, len(force) // 200) | 1) - baseline(force)


def calm_noise(force: Array) -> float:
    """Noise of the force, N: from sample to sample, and over the first samples if that is more."""
    return max(noise_of(force), spread(force[: _first(force)]))


def spread(values: Array) -> float:
    """Their standard deviation, without regard to spikes."""
    return 1.4826 * float(np.median(np.abs(values - np.median(values))))


def _first(force: Array) -> int:
    return max(FEWEST, len(force) // 50)


def exit_sample(depth: Array, force: Array) -> int | None:
    """The first sample in air after the last withdrawal; None if the needle does not come out.

    It is out where it is as shallow as in the air on the way in, and the force has come to its last level. If it ends a
    little deeper than that, the force must not have come to its last level deep in the tissue: a tip that leaves its
    wall has little force.
    """
    force = _without_spikes(force)
    entered, left = _departure(force), _departure(force[::-1])
    if entered is None or left is None:
        return None
    surface, out = float(depth[entered[0]]), len(force) - 1 - left[0]
    shallow = np.flatnonzero(depth[int(np.argmax(depth)) :] <= surface)
    if len(shallow) >= FEWEST:
        out = max(out, int(np.argmax(depth)) + int(shallow[0]))
        return out if depth[-1] <= surface and len(force) - out >= FEWEST else None
    half_way = 0.5 * (surface + float(depth.max()))
    is_out = depth[-1] <= surface + NEAR * float(np.ptp(depth)) and depth[out] < half_way
    return out if is_out and len(force) - out >= FEWEST else None


def without_turns_in_air(insertions: NDArray[np.int64], depth: Array, force: Array) -> NDArray[np.int64]:
    """The numbers of the insertions (n,) from 0 on, without those that stay in air, as where a hand turns there."""
    left = _departure(_without_spikes(force))
    if left is None or left[0] < FEWEST:
        return insertions
    deepest = np.array([depth[insertions == i].max() for i in range(int(insertions[-1]) + 1)])
    air = min(float(depth[left[0]]), 0.5 * float(depth.min() + depth.max()))
    return np.asarray(np.maximum(np.cumsum(deepest > air) - 1, 0)[insertions])


def leaves_air(force: Array, greatest: float) -> bool:
    """Whether a force (n,), N, leaves the air; greatest: that of the whole trace, N."""
    away = np.abs(above_air(_without_spikes(force)))
    return bool(away.max() > max(NOISES * calm_noise(force), SHARE * greatest))


def contact_sample(depth: Array, force: Array, after: Array | None = None) -> int | None:
    """The last sample before the force leaves the air. None if the force rises from the first samples on.

    depth, force: up to the end of the first insertion. after: the forces in air behind the tissue, N, if there are any.
    Among all depths of contact c, the one with which a + b (d - c) + e (d - c)^2 behind c, and a before it, fits best
    around the first departure. b has the sign of the departure: a dip into noise would put c too early.
    """
    force = _without_spikes(force)
    change = 0.0 if after is None else float(np.median(after)) - baseline(force)
    noise = 0.0 if after is None else spread(after)
    for share in (SHARE, FIRM):  # a drift in air may look like a first departure that begins at once
        found = _departure(force, change, noise, share)
        if found is None:
            continue
        best, top, left = _hinge(depth, force, *found)
        if best >= FEWEST and not _rises(depth, force, best, top):
            return _sooner(depth, force, found[0], best, top, left)
    return None


def _sooner(depth: Array, force: Array, calm: int, best: int, top: int, left: float) -> int:
    """The contact `best`, looked for in ever less of the rise where a parabola leaves more there than the noise.

    calm: the last sample within the noise. left: rms of what the parabola leaves up to the sample `top`, N.
    """
    air = force[: calm + 1]
    noise = max(spread(air) if len(air) >= MANY else 0.0, calm_noise(force), rounding(force))
    away = np.abs(force - float(np.median(air)))
    height = float(away.max())
    least = max(NOISES * noise, DIGITS * height)
    threshold, risen = float(away[calm:top].max()), top
    if threshold <= least:  # only the average over the samples has left the air by then
        threshold, risen, left = height, len(force), np.inf
    while left > max(SHAPED * noise, DIGITS * height) and risen - calm > 1 and threshold > least:
        threshold = max(threshold / FINER, least)
        lasting = np.convolve(away[calm:] > threshold, np.ones(LASTS), "valid") == LASTS
        if not lasting.any():
            break
        risen = calm + int(np.argmax(lasting)) + 1
        calm += int(np.flatnonzero(away[calm : risen - 1] <= 2 * noise).max(initial=0))
        best, _, left = _hinge(depth, force, calm, risen)
    return best


def _hinge(depth: Array, force: Array, calm: int, risen: int) -> tuple[int, int, float]:
    """The contact around the last calm sample and the first risen one, the end of what tells it, and the rms left."""
    top = min(risen + max(LASTS, risen - calm), len(force))
    first = max(0, calm - AROUND * (top - calm))
    used = np.unique(np.linspace(first, top - 1, min(top - first, 400)).astype(int))
    tried = used[:: max(1, len(used) // 100)]
    errors = _hinge_errors(depth[used], force[used], depth[tried])
    best = int(np.argmin(errors))
    return int(tried[best]), top, float(np.sqrt(errors[best] / len(used)))


def _rises(depth: Array, force: Array, contact: int, top: int) -> bool:
    """Whether the force rises with the depth before the contact as it does behind it, up to sample `top`: it is no air.

    Fewer samples than those that tell the zero must show that they are air. A needle that rests there shows it.
    """
    if float(np.ptp(depth[: contact + 1])) <= NOISES * noise_of(depth) or top - contact < FEWEST:
        return False
    (before, error), (behind, _) = (slope(depth[p], force[p]) for p in (slice(contact + 1), slice(contact, top)))
    doubt = SURE * error if contact < _first(force) else 0.0
    return bool(before * np.sign(behind) + doubt > STEEP * abs(behind))


def slope(x: Array, y: Array) -> tuple[float, float]:
    """Of y over x (n,), by least squares, and its standard error if the noise is white."""
    x, y = x - x.mean(), y - y.mean()
    square = max(float(x @ x), 1e-300)
    rise = float(x @ y) / square
    return rise, float(np.std(y - rise * x)) / float(np.sqrt(square))


def _without_spikes(force: Array) -> Array:
    padded = np.concatenate((force[:1], force, force[-1:]))
    return np.asarray(np.median(np.stack((padded[:-2], force, padded[2:])), axis=0))


def _departure(force: Array, change: float = 0.0, noise: float = 0.0, share: float = SHARE) -> tuple[int, int] | None:
    """The last sample within the noise of the first ones, and a sample that is well beyond it; None if there is none.

    change: of the zero over the trace, N, which is no departure. share: of the greatest force, that is beyond noise.
    """
    away = np.abs(above_air(force))
    height, noise = float(away.max()), max(noise, calm_noise(force))
    slow = abs(change) * np.linspace(0, 1, len(force))
    risen = away > max(NOISES * noise, share * height) + slow
    lasting = np.flatnonzero(np.convolve(risen, np.ones(LASTS), "valid") == LASTS)
    if len(lasting) == 0:
        lasting = np.flatnonzero(away > max(FIRM * height, 0.5 * NOISES * noise))
    if height == 0 or len(lasting) == 0:
        return None
    at = int(lasting[0])
    calm = np.flatnonzero(away[:at] <= 2 * noise + slow[:at])
    return (int(calm[-1]) if len(calm) else 0), at + 1


def _hinge_errors(depth: Array, force: Array, contacts: Array) -> Array:
    """Sum of the squared errors of the best hinge for each depth of contact (c,), N^2. It leaves the air one way."""
    behind = np.maximum(depth - contacts[:, None], 0) / max(float(np.ptp(depth)), 1e-12)
    flat = np.ones_like(behind)
    best, errors = _best(force, flat, behind, behind**2)
    one_way = best[:, 1] * (force[-1] - force[0]) >= 0
    return np.asarray(np.where(one_way, errors, _best(force, flat, behind**2)[1]))


def _best(force: Array, *shapes: Array) -> tuple[Array, Array]:
    """The factors of shapes (c, n) that fit a force (n,) best, for each c, and the sums of the squared errors."""
    each = np.stack(shapes, axis=1)  # (c, k, n)
    gram = each @ each.transpose(0, 2, 1) + 1e-12 * len(force) * np.eye(len(shapes))
    factors = np.linalg.solve(gram, (each @ force)[:, :, None])[:, :, 0]
    left = force - np.einsum("ckn,ck->cn", each, factors)
    return np.asarray(factors, np.float64), np.asarray(np.sum(left**2, axis=1))
