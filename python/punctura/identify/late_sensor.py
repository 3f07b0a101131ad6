"""Whether a trace shows that its sensor is late: K06 is fitted with a lag and a delay before the tissue is blamed."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import product

import numpy as np
from numpy.typing import NDArray

from punctura.identify.criteria import STRONG, Candidate, worth_a_fit
from punctura.identify.fit import Start, squares_beyond
from punctura.identify.intervals import Estimate
from punctura.identify.parameters import LATE, LATEST, Free
from punctura.identify.rig import Rig
from punctura.identify.search import Search
from punctura.trace import Trace

Array = NDArray[np.float64]

TYPICAL = 5e-3, 20e-3  # s, where a search begins
BEGINNINGS = (5e-3, 1.0), (20e-3, 1.0), (20e-3, 2.0), (20e-3, 4.0)  # s, and factors of the spring, of linear models
HALT = 0.9  # of the greatest lag: a search that ends beyond does not find one


def with_late_sensor(search: Search, current: Candidate) -> Candidate:
    """The current model with a lag, a delay or both of them, if the rule prefers it."""
    free = [name for name in LATE if name not in search.stated and name not in current.model.late]
    if search.ended or search.trace.time is None or not free or not _may_be_late(current, free):
        return current
    best = current
    for names in ((free[0],), (free[-1],), tuple(free)):
        model = replace(current.model, late=(*current.model.late, *names))
        if any(one.model == model for one in search.tried):
            continue
        starts = [Start(free.parameters(u)) for free, u in (_late(best, names, late) for late in TYPICAL)]
        found = search.fitted(" and ".join(names), model, starts)
        if found is None or max(abs(found.fit.parameters.late[LATE.index(name)]) for name in names) > HALT * LATEST:
            continue
        if search.rule.prefers(found, best):
            best = found
    return best


def without_late_sensor(search: Search, current: Candidate) -> Candidate:
    """The current model without a lag or a delay that is not worth it."""
    for name in current.model.late:
        late = tuple(one for one in current.model.late if one != name)
        start = Start(current.fit.parameters)
        found = search.fitted(f"without {name}", replace(current.model, late=late), [start])
        if found is not None and search.rule.prefers(found, current):
            return without_late_sensor(search, found)
    return current


def late_words(found: Mapping[str, Estimate], trace: Trace, rig: Rig) -> Iterator[str]:
    """A sentence for each lag and delay that was found, and one if stated ones could not be used."""
    if trace.time is None and any(rig.late.values()):
        yield "The stated lag or delay of the sensor is not taken into account: the trace has no time. Record it."
    for name, one in found.items():
        late = one.value > 0
        who = f"The measured {'force' if late else 'depth'} comes late"
        how = f"as behind a filter with a time constant of {_ms(one)}" if name == "lag" else f"by {_ms(one)}"
        yield (
            f"{who}, {how}. The fit takes it into account. If the rig has no such {name}, state it (--rig {name}_ms=0)."
        )


def _ms(one: Estimate) -> str:
    sign = 1e3 if one.value > 0 else -1e3
    bounds = (one.low, one.high) if one.value > 0 else (one.high, one.low)
    low, high = ("?" if bound is None else f"{sign * bound:.3g}" for bound in bounds)
    return f"{sign * one.value:.3g} ms [{low}, {high}]"


def _late(one: Candidate, names: Sequence[str], late: float) -> tuple[Free, Array]:
    """Coordinates with a lag or a delay more, of so many s if it is 0: pops are seen where they were."""
    fit = one.fit
    free = fit.misfit.free([*one.model.names, *(name for name in names if name not in one.model.late)], fit.parameters)
    u = free.coordinates(fit.parameters)
    added = [free.names.index(name) for name in names]
    u[added] = np.where(u[added] == 0, late, u[added])
    return free, u


def _may_be_late(current: Candidate, names: Sequence[str]) -> bool:
    """Whether a linear model that begins late gains enough with a lag or a delay, or a fit is not worth it.

    A soft spring hides most of what is late, so it also begins with stiffer ones: the way there is not straight.
    """
    fit = current.fit
    least = fit.sse
    for name, (late, stiffer) in product(names, BEGINNINGS):
        free, u = _late(current, [name], late)
        u[free.names.index("coupling_stiffness")] += np.log(stiffer)
        least = min(least, squares_beyond(fit.misfit, free, u))
    return worth_a_fit(fit, least, 1, STRONG)
