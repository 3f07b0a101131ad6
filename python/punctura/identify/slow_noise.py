"""The last fit beside slow noise of the sensor: the most likely parameters, not those of the least squares.

Least squares take slow noise up into the tissue. With a noise that is known, the pops, the turns and the holds tell
the tissue from it.
"""

from collections.abc import Sequence

from punctura.identify.air_noise import AirNoise
from punctura.identify.fit import Fit, Start, best_fit, in_order
from punctura.identify.moves import with_pops_moved
from punctura.identify.parameters import Parameters
from punctura.trace import TraceError

ROUNDS = 3  # each with the noise that the fit before shows
LOST = 3.0  # times the error of the fit without slow noise: what leaves more takes tissue for noise


def with_slow_noise(found: Fit, air: AirNoise, others: Sequence[Parameters] = ()) -> Fit:
    """The most likely fit for the correlated noise that the fit shows, if it shows some, and the air allows it.

    others: where searches begin, too.
    """
    most = LOST * found.rmse
    for _ in range(ROUNDS):
        noise, variance = found.measured.noise.most_likely()
        known = found.misfit.whitening
        if noise.share == 0 or (known is not None and known.mixture == noise) or not air.allows(noise, variance):
            break
        misfit = found.misfit.whitened(found.parameters, noise)
        try:
            starts = [Start(one) for one in (found.parameters, *others)]
            likely = in_order(with_pops_moved(best_fit(misfit, found.free.names, starts)))
        except TraceError:
            break
        if likely.rmse > most:
            break
        found = likely
    return found
