"""What is said where the force moves slowly about the model: a hum, a drift of the sensor, or a model that is wrong."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from punctura.identify.air_noise import AirNoise
from punctura.identify.causes import Cause
from punctura.identify.explained import SEEN
from punctura.identify.fit import Fit

DRIFTING = 1.5  # times the other noise: with more slow noise, intervals of least squares are too narrow
TOLD = 3.0  # standard deviations of slow noise: a wall that adds less is like one of its swings
PERIODS, FINE = 3, 4  # of a sine in the trace, at least; rates for each period more
ONE_SINE = 0.6  # of the squares beside white noise: a random walk has up to 0.4 in one sine


def slow_words(fit: Fit, air: AirNoise, explained: bool, whitened: bool) -> Iterator[str]:
    """What a hum or a drift of the sensor does to the intervals. The arguments are those of verdicts()."""
    slow = _slow(fit, explained, whitened)
    if slow is None:
        return
    if (swing := _swing(fit)) is not None:
        size, rate = swing
        yield (
            f"The measured force swings about the model by ±{size:.2g} N, {rate:.2g} times a second, as the hum of the "
            "mains does where it is sampled slowly. The fit takes it for slow noise, so the intervals may be wrong. To "
            "tell: sample at 500 Hz or more, or filter the force before it is sampled."
        )
    elif _of_sensor(fit, air):
        yield (
            f"The measured force drifts slowly about the model, by {slow:.2g} N. A wall that adds less than "
            f"{TOLD * slow:.2g} N ({TOLD:g} times this drift) cannot be told from it. "
            + (
                "The fit takes it into account, but intervals may be too narrow, above all that of a surface. "
                if whitened
                else "The intervals are then too narrow. "
            )
            + "If the model is right (see punctura rivals), this is a drift of the sensor: let it warm up, record a "
            "second before contact, and repeat the insertion."
        )


def slow_misfit(fit: Fit, air: AirNoise, explained: bool) -> tuple[Cause, ...]:
    """The cause, if the force moves slowly about the model, and the sensor does not do that in air."""
    if _slow(fit, explained) is None or _swing(fit) is not None or _of_sensor(fit, air):
        return ()
    text = (
        f"The model misses the measured force by {fit.rmse:.2g} N, in long stretches. "
        + ("" if _steps(fit) else "This is no drift of the sensor, whose force in air does not show it. ")
        + "Do not trust the intervals"
    )
    return (Cause("slow_misfit", 0.0, text),)


def _slow(fit: Fit, explained: bool, whitened: bool = False) -> float | None:
    """Slow noise that matters, N; None if there is none, or if the trace is said to be not explained."""
    likely, other = fit.noise.slow_and_white()
    slow = min(likely, fit.rmse)  # noise that is slower than the trace is known to no more than what the fit leaves
    much = (likely if whitened else slow) > DRIFTING * other  # the last fit takes it for as much as is likely
    return slow if explained and much and slow > SEEN * float(np.max(np.abs(fit.misfit.trace.force))) else None


def _of_sensor(fit: Fit, air: AirNoise) -> bool:
    """Whether the slow noise may be a drift of the sensor: its force in air allows it."""
    return air.allows(*fit.noise.most_likely()) and not _steps(fit)


def _steps(fit: Fit) -> bool:
    """Whether the force steps in air: what is slow may be a force of the rig then."""
    return any(finding.kind == "air_steps" for finding in fit.misfit.trace.findings)


def _swing(fit: Fit) -> tuple[float, float] | None:
    """Size, N, and rate, Hz, of a sine that is most of the residuals beside the other noise; None if none is."""
    time, left = fit.misfit.trace.time, fit.misfit.forces(fit.parameters) - fit.misfit.trace.force
    if time is None:
        return None
    rates = np.arange(FINE * PERIODS, FINE * len(time) // 4) / (FINE * float(np.ptp(time)))
    waves = np.abs([np.exp(-2j * np.pi * rate * (time - time[0])) @ left for rate in rates])
    size, rate = 2 * float(waves.max(initial=0.0)) / len(time), float(rates[int(np.argmax(waves))])
    other = fit.noise.slow_and_white()[1]
    return (size, rate) if size**2 / 2 > ONE_SINE * (float(np.var(left)) - other**2) else None
