"""Whether a trace shows that its sensor is late, or its drive has play, before the tissue is blamed for it.

K06 is fitted with a lag, a delay, and a play. A delay moves the force by a time, and a play by a way, at each turn.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import product

import numpy as np
from numpy.typing import NDArray

from punctura.identify.criteria import STRONG, Candidate, worth_a_fit
from punctura.identify.depth_noise import rounding_noise
from punctura.identify.fit import Fit, Start, squares_beyond
from punctura.identify.intervals import Estimate
from punctura.identify.parameters import LATE, LATEST, Free
from punctura.identify.rig import Rig
from punctura.identify.search import Search
from punctura.identify.uncertainty import Uncertainty
from punctura.trace import Trace
from punctura.trace.turns import noise_of

Array = NDArray[np.float64]

# Where a search begins, s and m.
TYPICAL = {"lag": (5e-3, 20e-3), "delay": (5e-3, 20e-3), "play": (20e-6, 80e-6), "slack": (20e-6, 80e-6)}
BEGINNINGS = (0, 1.0), (1, 1.0), (1, 2.0), (1, 4.0)  # which of these, and factors of the spring, of linear models
OF_DRIVE = "play", "slack"
SHAKES, SEEN = 10.0, 3.0  # times the noise of the depth, and its own error: a play that is less is none
HALT = 0.9  # of the greatest lag: a search that ends beyond does not find one


def with_late_sensor(search: Search, current: Candidate) -> Candidate:
    """The current model with a lag, a delay, both of them, or a play, if the rule prefers it."""
    known = (*search.stated, *current.model.late)
    free = [name for name in LATE if name not in known and _told(search, name)]
    if search.ended or not free or not _may_be_late(current, free):
        return current
    best = current
    timed = tuple(name for name in free if name not in OF_DRIVE)
    for names in dict.fromkeys([*((name,) for name in timed), timed, *((name,) for name in free if name in OF_DRIVE)]):
        model = replace(current.model, late=(*current.model.late, *names))
        if not names or any(one.model == model for one in search.tried) or model in search.refused:
            continue
        starts = [Start(free.parameters(u)) for free, u in (_late(best, names, i) for i in (0, 1))]
        found = search.fitted(" and ".join(names), model, starts)
        if found is None or not all(_may_be(search, name, found.fit) for name in names):
            search.tried = [one for one in search.tried if one is not found]
            search.refused.append(model)  # it must not be chosen as the best of all
            continue
        if search.rule.prefers(found, best):
            best = found
    return best


def _told(search: Search, name: str) -> bool:
    """Whether the trace can show it: what is late needs a time, a play a turn, at which the depth was read in time."""
    if name not in OF_DRIVE:
        return search.trace.time is not None
    held = any(finding.kind == "depth_held" for finding in search.trace.findings)
    return not held and any(stroke.kind == "out" for stroke in search.segments.strokes)


def _may_be(search: Search, name: str, found: Fit) -> bool:
    """Whether a value that was found counts. A small play also takes noise and steps out of the depth."""
    value = found.parameters.get(name)
    if name in OF_DRIVE:
        depth, draws = search.trace.depth, search.trace.depths
        unknown = 0.0 if draws is None else float(draws.std(axis=0).max())
        j = found.free.names.index(name)
        error = float(np.sqrt(max(Uncertainty(found).covariance[j, j], 0.0)))
        if value < max(SHAKES * max(noise_of(depth), rounding_noise(depth), unknown), SEEN * error):
            return False
    return abs(value) <= HALT * LATEST[name]


def without_late_sensor(search: Search, current: Candidate) -> Candidate:
    """The current model without a lag, a delay or a play that is not worth it."""
    for name in current.model.late:
        late = tuple(one for one in current.model.late if one != name)
        start = Start(current.fit.parameters)
        found = search.fitted(f"without {name}", replace(current.model, late=late), [start])
        if found is not None and search.rule.prefers(found, current):
            return without_late_sensor(search, found)
    return current


def not_told_apart(search: Search, current: Candidate) -> Iterator[str]:
    """A sentence if the trace cannot tell what was found from another error of the rig, which is fitted instead."""
    drive = [name for name in current.model.late if name in OF_DRIVE]
    if drive and search.trace.time is None:
        yield (
            f"Without time, a sensor that is late looks as the {drive[0]} of a drive does. If it is late, the "
            "intervals do not hold: record the time."
        )
    if len(current.model.late) != 1 or not (drive or any(_told(search, name) for name in OF_DRIVE)):
        return
    (name,) = current.model.late
    known = (*search.stated, name)
    alike = []
    for other in (one for one in LATE if one not in known and _told(search, one)):
        if not (drive or other in OF_DRIVE):
            continue
        model = replace(current.model, late=(other,))
        one = next((one for one in search.tried if one.model == model), None)
        if one is None and model not in search.refused:
            here = current.fit.parameters.with_values({name: 0.0})
            one = search.fitted(other, model, [Start(here.with_values({other: at})) for at in TYPICAL[other]])
            one = one if one is not None and _may_be(search, other, one.fit) else None
        if one is not None and one.worth(current.effective).bic - current.worth(current.effective).bic < STRONG:
            alike.append(other)
    if alike:
        yield (
            f"The trace cannot tell the {name} from a {' or a '.join(alike)}, which explains it as well. The intervals "
            "are those of the first. To tell: insert at another speed, or turn back and forth inside the tissue; the "
            "way of a play does not depend on the speed. State what the rig has not (--rig "
            f"{alike[0]}_{'um' if alike[0] in OF_DRIVE else 'ms'}=0)."
        )


def late_words(found: Mapping[str, Estimate], trace: Trace, rig: Rig) -> Iterator[str]:
    """A sentence for each lag, delay and play that was found, and one if stated ones could not be used."""
    if trace.time is None and (rig.lag or rig.delay):
        yield "The stated lag or delay of the sensor is not taken into account: the trace has no time. Record it."
    for name, one in found.items():
        if name in OF_DRIVE:
            where = "it turns, the needle stays" if name == "play" else "the force changes its sign, the needle slips"
            yield (
                f"The depth is as if the drive had play: where {where} for {_of(one)}. The fit takes it into account. "
                f"If the rig has none, state it (--rig {name}_um=0)."
            )
            continue
        late = one.value > 0
        who = f"The measured {'force' if late else 'depth'} comes late"
        how = f"as behind a filter with a time constant of {_of(one)}" if name == "lag" else f"by {_of(one)}"
        yield (
            f"{who}, {how}. The fit takes it into account. If the rig has no such {name}, state it (--rig {name}_ms=0)."
        )


def _of(one: Estimate) -> str:
    unit, size = ("um", 1e6) if one.unit == "m" else ("ms", 1e3)
    sign = size if one.value > 0 else -size
    bounds = (one.low, one.high) if one.value > 0 else (one.high, one.low)
    low, high = ("?" if bound is None else f"{sign * bound:.3g}" for bound in bounds)
    return f"{sign * one.value:.3g} {unit} [{low}, {high}]"


def _late(one: Candidate, names: Sequence[str], which: int) -> tuple[Free, Array]:
    """Coordinates with these more, with the first or second of TYPICAL if it is 0: pops are seen where they were."""
    fit = one.fit
    free = fit.misfit.free([*one.model.names, *(name for name in names if name not in one.model.late)], fit.parameters)
    u = free.coordinates(fit.parameters)
    added = [free.names.index(name) for name in names]
    u[added] = np.where(u[added] == 0, [TYPICAL[name][which] for name in names], u[added])
    return free, u


def _may_be_late(current: Candidate, names: Sequence[str]) -> bool:
    """Whether a linear model that begins late gains enough with one of these, or a fit is not worth it.

    A soft spring hides most of what is late, so it also begins with stiffer ones: the way there is not straight.
    """
    fit = current.fit
    least = fit.sse
    for name, (which, stiffer) in product(names, BEGINNINGS):
        free, u = _late(current, [name], which)
        u[free.names.index("coupling_stiffness")] += np.log(stiffer)
        least = min(least, squares_beyond(fit.misfit, free, u))
    return worth_a_fit(fit, least, 1, STRONG)
