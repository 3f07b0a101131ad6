"""The model with all extensions at once, and without those that are not worth it."""

from __future__ import annotations

from punctura.identify.criteria import Candidate
from punctura.identify.fit import Start
from punctura.identify.model import extensions
from punctura.identify.moves import noise_limit
from punctura.identify.search import Search, seen

ALL = "all extensions"


def from_all(search: Search, current: Candidate) -> Candidate:
    """The model with all extensions that the trace can show, reduced, if the rule prefers it.

    With several walls, an extension is often worth it only at an optimum where the others are there, too. So hops look
    for the best end of all together.
    """
    model, enough = current.model, noise_limit(search.trace)
    if model.membranes < 2 or current.fit.weighted_rmse < enough:
        return current
    for _ in range(2):  # the second branch of a relaxation comes after the first one
        for extension in extensions(search.needle):
            if seen(search.segments, extension, model):
                model = model.extended(extension)
    if model == current.model:
        return current
    here = current.fit.parameters
    found = search.fitted(ALL, model, [Start(model.start(here, weak)) for weak in (True, False)], hops=True)
    if found is None:
        return current
    found = reduced(search, found)
    return found if search.rule.prefers(found, current) else current


def reduced(search: Search, current: Candidate) -> Candidate:
    """Without the extensions that are not worth it where the current fit ends."""
    while True:
        fits = []
        for extension in current.model.extensions:
            model = current.model.without(extension)
            start = Start(model.switched_off(current.fit.parameters))
            found = search.fitted(f"without {extension.name}", model, [start])
            if found is not None:
                fits.append(found)
        preferred = [one for one in fits if search.rule.prefers(one, current)]
        if not preferred:
            return current
        current = min(preferred, key=lambda one: one.worth(current.effective).bic)
