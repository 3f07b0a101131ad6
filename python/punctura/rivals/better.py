"""Which rivals explain a trace better than the identified model does."""

from __future__ import annotations

from punctura.identify import Identification
from punctura.identify.criteria import EVIDENCE
from punctura.rivals.comparison import Row, TraceComparison, compare_trace
from punctura.rivals.k06 import CHOSEN, PRINTED


def better_rivals(found: Identification) -> tuple[TraceComparison, tuple[Row, ...]]:
    """All rivals on the trace of an identification, and those with a smaller BIC and a smaller error."""
    table = compare_trace(found.trace, needle=found.parameters.needle, with_chatter=False, identified=found)
    own = [row for row in table.rows if row.name in (PRINTED, CHOSEN)]
    bic = min(row.bic for row in own)
    error = min(row.rmse for row in own)
    better = [row for row in table.rows if row not in own and row.bic < bic - EVIDENCE and row.rmse < error]
    return table, tuple(sorted(better, key=lambda row: row.bic))


def in_words(found: Identification) -> str:
    """One sentence on the rivals, for a trace that the model does not explain."""
    table, better = better_rivals(found)
    rmse = min(row.rmse for row in table.rows if row.name in (PRINTED, CHOSEN))
    own = f"K06 {rmse:.2g} N (punctura rivals)"
    if better:
        return f"Another model does better: {'; '.join(map(_leaves, better[:2]))}, and {own}."
    rivals = [row for row in table.rows if row.name not in (PRINTED, CHOSEN)]
    return f"No rival does better: {_leaves(min(rivals, key=lambda row: row.bic))}, and {own}."


def _leaves(row: Row) -> str:
    return f"{row.title} leaves {row.rmse:.2g} N"
