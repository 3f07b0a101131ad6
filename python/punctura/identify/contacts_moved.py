"""Fits again with other precompressions where no pop shows the place of a wall: least squares do not move a contact."""

from __future__ import annotations

from punctura.identify.fit import Fit, best_of, fit
from punctura.trace import TraceError

SHARES = (0.1, 0.2, 0.4, 0.8)  # of the greatest force of the trace, as precompressions


def with_contacts_moved(found: Fit) -> Fit:
    """The fit, or a better one that starts with another precompression of a wall that pops behind the trace.

    The force jumps at a contact, by a part of the precompression. A search from an early contact without a jump does
    not find a later contact with one, because that moves the jump over samples. Ends that explain the trace nearly as
    well are among `others`.
    """
    free, ends = found.free, [found]
    popped = {k for k, _ in free.walls}
    for k, name in enumerate(free.names):
        precompression = name.replace(".surface", ".precompression")
        if not name.endswith(".surface") or k in popped or precompression not in free.names:
            continue
        here = min(ends, key=lambda end: end.sse).parameters
        for share in SHARES:
            start = here.with_values({precompression: share * float(found.misfit.trace.force.max())})
            try:
                ends.append(fit(found.misfit, free.names, start))
            except TraceError:
                continue
    return best_of(ends)
