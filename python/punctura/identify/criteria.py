"""Which of two models a trace prefers."""

from dataclasses import dataclass

import numpy as np

from punctura.identify.air_noise import AirNoise
from punctura.identify.fit import Fit, Misfit, fit
from punctura.identify.model import Model
from punctura.identify.noise import NoiseOfFit, effective_samples
from punctura.identify.slow_noise import with_slow_noise
from punctura.trace import Segments, Trace, TraceError
from punctura.trace.information import Information, held_out, information
from punctura.trace.turns import noise_of

EVIDENCE = 2.0  # by which BIC must prefer the larger model; less is "not worth a mention" (Kass and Raftery 1995)
STRONG = 6.0  # the same for a sensor that is late, which no trace without it may show: "strong" evidence
HALF = 0.5  # a linear model sees less than a fit finds
ALMOST_NONE = 1e-6  # s, of a lag
NOISY = 1.2  # times the noise: where a model leaves more, it is wrong otherwise, and tells nothing of the sensor
TAKEN = 0.05  # of the squares, that a relaxation takes at least where a rest shows one
RELAXATION = "relaxation"  # begins the names of its parameters
FAR_AWAY = 1.0  # m, of a surface: no needle comes to it
WORSE = 1.02  # a held-out error that is higher by less than this factor is not worse


@dataclass(frozen=True, eq=False)
class Candidate:
    """A model that was tried, fitted to the samples of the search. effective: the independent ones of its residuals."""

    name: str
    model: Model
    fit: Fit
    effective: float
    held_out: float | None = None  # N, rms of samples that the fit did not use; None if it was not measured

    @property
    def extensions(self) -> tuple[str, ...]:
        """The extensions of K06, with "one tissue" if all walls share stiffness, friction and thickness."""
        return self.model.words

    def worth(self, effective: float) -> Information:
        """AIC (the corrected form) and BIC with this number of independent samples."""
        return information(self.fit.residuals, len(self.fit.u), effective)


def candidate(name: str, model: Model, fit: Fit) -> Candidate:
    """A fitted model with the effective number of its samples."""
    return Candidate(name, model, fit, effective_samples(fit.residuals, len(fit.u)))


def worth_a_fit(current: Fit, squares: float, more: int, needed: float = EVIDENCE) -> bool:
    """Whether a linear model with so many parameters more, that leaves these squares, N^2, promises HALF of what BIC
    asks for, if all samples are independent ones.
    """
    n = len(current.residuals)
    return bool(n * np.log(current.sse / max(squares, 1e-300)) > HALF * (more * np.log(n) + needed))


def _relaxing(one: Candidate) -> bool:
    return any(name.startswith(RELAXATION) for name in one.model.names)


class Rule:
    """Compares candidates of one trace. BIC decides; a larger model must also predict samples that it did not see."""

    def __init__(self, trace: Trace, segments: Segments) -> None:
        self._masks = held_out(len(trace), segments)
        self.air = AirNoise(trace, segments)
        self._noise = noise_of(trace.force)
        self._errors: dict[Candidate, float | None] = {}
        self._late: dict[Candidate, bool] = {}
        self._likely: dict[Candidate, Fit] = {}

    def prefers(self, new: Candidate, old: Candidate) -> bool:
        """Whether `new` is the better model.

        Both BIC count the independent samples of the candidate with the smaller error. The smaller model wins unless
        the larger one's BIC is smaller by more than EVIDENCE. To add a lag or a delay of the sensor it must be STRONG,
        and little more than noise may be left. Where the force relaxes, no model without a relaxation is better than
        one whose relaxation takes a share of the squares.
        """
        if self.air.relaxes and _relaxing(new) != _relaxing(old):
            relaxing, rigid = (new, old) if _relaxing(new) else (old, new)
            if relaxing.fit.sse < (1 - TAKEN) * rigid.fit.sse:
                return relaxing is new
        effective = min(new, old, key=lambda one: one.fit.sse).effective
        gain = old.worth(effective).bic - new.worth(effective).bic
        late, before = set(new.model.late), set(old.model.late)
        if late - before and before - late:  # other errors of the rig: neither is the larger model
            slow = len(new.fit.u) > len(old.fit.u) and self._may_be_slow_noise(new, old)
            little = new.fit.weighted_rmse < NOISY * self._noise
            return gain > 0 and little and not slow and self._predicts(new, old)
        larger, smaller = (new, old) if len(new.fit.u) > len(old.fit.u) else (old, new)
        needed = EVIDENCE
        if set(larger.model.late) - set(smaller.model.late):
            shown = larger.fit.weighted_rmse < NOISY * self._noise and self._is_late(larger)
            needed = STRONG if shown else np.inf
        if larger is old:
            if len(new.fit.u) == len(old.fit.u):
                return gain > 0
            fewer = len(new.fit.parameters.membranes) < len(old.fit.parameters.membranes)
            return gain >= -needed or (fewer and self._may_be_slow_noise(old, new))
        if gain <= needed or self._may_be_slow_noise(new, old):
            return False
        return self._predicts(new, old)

    def touches(self, one: Candidate) -> bool:
        """Whether its walls are more than a zero, forces of the rig and noise, also slow noise that the air allows."""
        found = one.fit
        away = {f"membrane[{i}].surface": FAR_AWAY for i in range(one.model.membranes)}
        try:
            nothing = fit(found.misfit, ("offset", *one.model.rig), found.parameters.with_values(away))
        except TraceError:
            return True
        more = len(found.u) - len(nothing.u)
        needed = STRONG + more * float(np.log(len(found.residuals)))
        left, least = (each.noise.misfit_beyond_slow_noise(self.air.allows) for each in (nothing, found))
        return left - least > needed

    def _predicts(self, new: Candidate, old: Candidate) -> bool:
        """Whether the held-out error of `new` is not worse."""
        after, before = self.held_out_error(new), self.held_out_error(old)
        return after is not None and (before is None or after <= WORSE * before)

    def _may_be_slow_noise(self, new: Candidate, old: Candidate) -> bool:
        """Whether what `new` adds may be slow noise of the sensor.

        It may be unless BIC prefers `new` also where slow noise may explain what each model leaves: such as air of
        enough samples does not exclude. If `old` leaves such noise, the evidence must be STRONG: a wall that never pops
        is like a slow change, and walls must be worth it where both fits follow that noise, too. A relaxation looks
        like a drift, so there it is as much as the air allows.
        """
        added = set(new.model.names) - set(old.model.names)
        relaxing = any(name.startswith(RELAXATION) for name in added)
        more = len(new.fit.u) - len(old.fit.u)  # it may also have some less, or others shared by all walls
        noise = self.air.allows if relaxing else self.air.tested
        left = old.fit.noise.most_likely()
        slow = left[0].share > 0 and self.air.tested(*left)
        needed = (STRONG if slow else EVIDENCE) + more * float(np.log(len(new.fit.residuals)))
        left_old, left_new = (one.fit.noise.misfit_beyond_slow_noise(noise) for one in (old, new))
        walls = len(new.fit.parameters.membranes) > len(old.fit.parameters.membranes)
        if left_old - left_new > needed and slow and walls:
            left_old = min(left_old, self._beside_slow_noise(old).misfit_beyond_slow_noise(noise))
            if left_old - left_new <= needed:
                left_new = min(left_new, self._beside_slow_noise(new).misfit_beyond_slow_noise(noise))
        return left_old - left_new <= needed

    def _beside_slow_noise(self, one: Candidate) -> NoiseOfFit:
        """What the likely fit beside slow noise leaves.

        Least squares move a pop by some samples where slow noise fits better then, and slow noise takes no such step.
        """
        if one not in self._likely:
            self._likely[one] = with_slow_noise(one.fit, self.air).measured
        return self._likely[one].noise

    def _is_late(self, one: Candidate) -> bool:
        """Whether a lag is worth it beside one of almost 0, whose fine steps alone follow a pop better."""
        if one not in self._late and "lag" in one.model.late:
            names = [name for name in one.model.names if name != "lag"]
            try:
                none = fit(one.fit.misfit, names, one.fit.parameters.with_values({"lag": ALMOST_NONE}))
            except TraceError:
                return True
            gain = information(none.residuals, len(names), one.effective).bic - one.worth(one.effective).bic
            self._late[one] = gain > STRONG
        return self._late.get(one, True)

    def held_out_error(self, one: Candidate) -> float | None:
        """The rms error, N, at samples that the fit did not use; None if a fit without them does not end."""
        if one not in self._errors:
            self._errors[one] = self._held_out_error(one.fit)
        return self._errors[one]

    def _held_out_error(self, found: Fit) -> float | None:
        squares = []
        for out in self._masks:
            whole = found.misfit
            part = Misfit(whole.trace, found.parameters, ~out, whole.zero, whole.depth_error)
            try:
                kept = fit(part, found.free.names, found.parameters)
            except TraceError:
                return None
            finally:
                whole.evaluations += part.evaluations
            squares.append((part.forces(kept.parameters) - found.misfit.trace.force)[out] ** 2)
        return float(np.sqrt(np.mean(np.concatenate(squares)))) if squares else None
