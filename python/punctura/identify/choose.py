"""Chooses the model that a trace asks for: the extensions of K06, and the number of its membranes."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

from punctura import Needle
from punctura.identify.air_noise import seen_in_air
from punctura.identify.criteria import EVIDENCE, NOISY, Candidate, worth_a_fit
from punctura.identify.fit import Start, squares_beyond
from punctura.identify.late_sensor import with_late_sensor, without_late_sensor
from punctura.identify.model import ONE_TISSUE, Extension, Model, extensions
from punctura.identify.moves import GAIN, noise_limit, with_hops
from punctura.identify.parameters import Parameters
from punctura.identify.rig import UNKNOWN, Rig
from punctura.identify.search import Search, seen
from punctura.identify.walls import with_a_wall_more, without_a_wall
from punctura.trace import Segments, Trace
from punctura.trace.ends import without_zero

ALL = "all extensions"
SETTLED = 2  # better optima of the chosen model, found by hops, at most
MOST_CHANGES = 3  # of the number of membranes, each by one
FAR = 1.5  # times the noise: then the fits of one membrane more hop, too
FRESH = 6  # starts of one membrane more
PASSES = 3  # over the extensions, at most: one may be worth it only after another
WHITE = 0.8  # of the samples are independent: the residuals have no shape, so no wall is missing


@dataclass(eq=False)
class Choice:
    """All models that were tried for a trace. docs/identify.md has the rule.

    most: if given, one membrane fewer and one more (up to this number) are tried, too.
    """

    search: Search
    plain: Candidate  # K06 itself
    current: Candidate  # the chosen model
    most: int | None

    @property
    def candidates(self) -> tuple[Candidate, ...]:
        """The chosen model first; it and K06 have a held-out error."""
        rule = self.search.rule
        errors = {one: rule.held_out_error(one) for one in (self.current, self.plain)}
        rest = [one for one in self.search.tried if one is not self.current]
        return tuple(replace(one, held_out=errors.get(one)) for one in (self.current, *rest))

    def settle(self) -> None:
        """Chooses a model, and again as long as hops find a better optimum of the chosen one."""
        self.extend()
        for _ in range(0 if self.search.ended else SETTLED):
            hopped = with_hops(self.current.fit)
            if not hopped.sse < (1 - GAIN) * self.current.fit.sse:
                break
            self.again(hopped.parameters)

    def extend(self) -> None:
        """Chooses extensions of the current model and its number of membranes."""
        first = self.current
        current = _extended(self.search, with_late_sensor(self.search, first))
        if current.model.late != first.model.late:  # or the tissue explains it
            _extended(self.search, first)
            current = self._best_of_all(current)
        current = from_all(self.search, current)
        if current.model.membranes > 1 and not current.model.one_tissue:
            tied = _of_one_tissue(self.search, current)
            if tied is not current:
                current = _extended(self.search, tied)
        for _ in range(0 if self.most is None else MOST_CHANGES):
            before, current = current, _other_number(self.search, current, self.most or 0)
            if current is before:
                break
        late = with_late_sensor(self.search, current)
        current = without_late_sensor(self.search, current if late is current else reduced(self.search, late))
        self.current = self._best_of_all(current)

    def _best_of_all(self, current: Candidate) -> Candidate:
        """The current model, or a better one that was tried: the last one chosen need not be the best."""
        seen = [current]
        while better := [
            one
            for one in self.search.tried
            if one not in seen and self._may_be_chosen(one) and self.search.rule.prefers(one, current)
        ]:
            current = min(better, key=lambda one: one.worth(current.effective).bic)
            seen.append(current)
        return current

    def _may_be_chosen(self, one: Candidate) -> bool:
        return self.most is not None or one.model.membranes == self.current.model.membranes

    def again(self, better: Parameters) -> None:
        """Chooses again from a better optimum of the chosen model.

        Fits of larger models began at the lesser optimum, so they count no longer. Where the search uses only some of
        the samples, the optimum may be better only with all of them: then the choice stays.
        """
        old, search = self.current, self.search
        new = search.fitted(old.name, old.model, [Start(better)])
        if new is None or not new.fit.sse < old.fit.sse:
            search.tried = [one for one in search.tried if one is not new]
            return
        more = set(old.model.names)
        search.tried = [
            new if one is old else one for one in search.tried
            if one is not new and not more < set(one.model.names)
        ]  # fmt: skip
        self.plain = new if self.plain is old else self.plain
        self.current = new
        if old.worth(new.effective).bic - new.worth(new.effective).bic > EVIDENCE:
            self.extend()


def choose(
    trace: Trace,
    segments: Segments,
    needle: Needle,
    membranes: int,
    report: Callable[[str], None] = lambda _: None,
    *,
    most: int | None = None,
    rig: Rig = UNKNOWN,
) -> Choice:
    """Tries the models that this trace may ask for, and chooses one."""
    of_rig = seen_in_air(trace)
    choice = _choice(Search(trace, segments, needle, report, rig.late), Model(membranes, rig=of_rig), most)
    if without_zero(trace) and choice.current.fit.weighted_rmse > NOISY * noise_limit(trace):
        without = tuple(name for name in of_rig if name != "slide_friction")  # it is of tissue
        other = _choice(Search(trace, segments, needle, report, rig.late), Model(membranes, rig=without), most)
        effective = min(choice.current, other.current, key=lambda one: one.fit.sse).effective
        choice = min(choice, other, key=lambda one: one.current.worth(effective).bic)
    return choice


def _choice(search: Search, model: Model, most: int | None) -> Choice:
    plain = search.fitted("K06", model, search.starts(model.membranes, False, 3))
    assert plain is not None
    choice = Choice(search, plain, plain, most)
    choice.settle()
    return choice


def _extended(search: Search, current: Candidate) -> Candidate:
    """Adds extensions, one after the other, as long as one is worth it."""
    for _ in range(PASSES):
        before = current
        for extension in _in_order(search):
            if search.ended or not seen(search.segments, extension, current.model):
                continue
            model = current.model.extended(extension)
            if any(one.model == model for one in search.tried):
                continue  # it was not worth it
            here = current.fit.parameters
            from_these = [Start(model.start(here, weak)) for weak in (True, False)]
            if not _may_be_worth_it(current, model, from_these):
                continue
            curved = "tissue.growth" in extension.start
            if curved or (extension.needs_hold and not extension.after):  # K06 alone bends to a rest, far from both
                fresh = search.starts(model.membranes, curved, 2)
                from_these += [replace(one, parameters=model.start(one.parameters)) for one in fresh]
            found = search.fitted(extension.name, model, from_these)
            if found is not None and search.rule.prefers(found, current):
                current = found
        if current is before:
            break
    return current


def _may_be_worth_it(current: Candidate, model: Model, starts: Sequence[Start]) -> bool:
    """Whether a larger model can be worth a fit: the residuals have a shape, or a linear model gains enough."""
    fit = current.fit
    if current.effective < WHITE * len(fit.residuals):
        return True
    least = fit.sse
    for start in starts:
        free = fit.misfit.free(model.names, start.parameters)
        least = min(least, squares_beyond(fit.misfit, free, free.coordinates(start.parameters)))
    return worth_a_fit(fit, least, len(model.names) - len(fit.u))


def _in_order(search: Search) -> list[Extension]:
    """Every extension. A relaxation that a rest shows comes first: without it, the others bend to the rest."""
    return sorted(extensions(search.needle), key=lambda one: not (search.rule.air.relaxes and one.needs_hold))


def _of_one_tissue(search: Search, current: Candidate) -> Candidate:
    """The same model with one stiffness, friction and thickness for all walls, if the rule prefers it."""
    model = replace(current.model, one_tissue=True)
    from_these = [Start(model.start(current.fit.parameters), blurred=True)]
    if "tissue.growth" in model.names:
        fresh = search.starts(model.membranes, True, 3)
        from_these += [replace(one, parameters=model.start(one.parameters)) for one in fresh]
    found = search.fitted(ONE_TISSUE, model, from_these)
    return found if found is not None and search.rule.prefers(found, current) else current


def _other_number(search: Search, current: Candidate, most: int) -> Candidate:
    """One membrane fewer, and one more where the residuals still have a shape: the rule decides."""
    count, best = current.model.membranes, current
    if count > 1:
        fewer = replace(current.model, membranes=count - 1, one_tissue=current.model.one_tissue and count > 2)
        from_these = [Start(p, blurred=True) for p in without_a_wall(current.fit, search.segments)]
        from_these += [replace(s, parameters=fewer.start(s.parameters)) for s in search.starts(count - 1, False, 1)]
        found = search.fitted(f"{count - 1} membrane(s)", fewer, from_these)
        if found is not None and search.rule.prefers(found, best):
            best = found
    if count < most and current.effective < WHITE * len(search.trace) and not search.ended:
        for found in _one_more(search, current):
            if search.rule.prefers(found, best):
                best = found
    return best


def _one_more(search: Search, current: Candidate) -> Iterator[Candidate]:
    """The model with one membrane more, and K06 with so many, with its own extensions where it leaves less.

    An extension may be there only because a wall is missing.
    """
    count, plain = current.model.membranes + 1, replace(search.tried[0].model, late=current.model.late)
    fresh = search.starts(count, False, FRESH)
    models = [replace(current.model, membranes=count)]
    models += [replace(plain, membranes=count)] if current.model.words else []
    far = current.fit.weighted_rmse > FAR * noise_limit(search.trace)
    for model in models:
        from_these = [replace(one, parameters=model.start(one.parameters)) for one in fresh]
        if model is models[0]:
            from_these += [Start(one) for one in with_a_wall_more(current.fit)]
        found = search.fitted(f"{count} membranes", model, from_these, hops=far)
        if found is not None and found.fit.sse < current.fit.sse:
            yield found if model is models[0] else _extended(search, found)


def from_all(search: Search, current: Candidate) -> Candidate:
    """The model with all extensions that the trace can show, reduced, if the rule prefers it.

    With several walls, an extension is often worth it only at an optimum where the others are there, too. So hops look
    for the best end of all together.
    """
    model, noise = current.model, noise_limit(search.trace)
    white = current.effective >= WHITE * len(search.trace)
    if search.ended or model.membranes < 2 or current.fit.weighted_rmse < (FAR if white else 1.0) * noise:
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
