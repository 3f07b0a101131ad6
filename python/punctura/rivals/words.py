"""A comparison as a table, as sentences, and as JSON."""

import math
from typing import TypedDict

from punctura.rivals.comparison import Row, TraceComparison

HEAD = (
    "model", "numbers", "rmse N", "% of peak", "AIC", "BIC", "held out N", "to 1st pop %", "its AIC", "rest mN",
    "hand mN",
)  # fmt: skip


class LayerRecord(TypedDict):
    """A layer of a fitted rival."""

    surface_m: float
    numbers: dict[str, float]


class ModelRecord(TypedDict):
    """A row of the table, SI. None: no value."""

    name: str
    title: str
    parameters: int
    rmse_N: float
    rmse_share_of_peak: float
    aic: float | None
    bic: float | None
    held_out_rmse_N: float | None
    first_stretch_rmse_share: float | None
    first_stretch_aic: float | None
    chatter_rest_N: float | None
    chatter_hand_N: float | None
    converged: bool
    starts: int
    starts_that_agree: int
    layers: list[LayerRecord]


class ComparisonRecord(TypedDict):
    """The JSON of `punctura rivals --json`."""

    trace: str
    samples: int
    peak_N: float
    effective_samples: float
    models: list[ModelRecord]
    notes: list[str]


def table(comparison: TraceComparison) -> str:
    """One line a model, the one with the least AIC first."""
    rows = [HEAD, *(_cells(row) for row in comparison.rows)]
    widths = [max(len(row[i]) for row in rows) for i in range(len(HEAD))]
    lines = []
    for name, *numbers in rows:
        cells = [name.ljust(widths[0]), *(n.rjust(w) for n, w in zip(numbers, widths[1:], strict=True))]
        lines.append("  ".join(cells).rstrip())
    return "\n".join(lines)


def _cells(row: Row) -> tuple[str, ...]:
    shake = row.chatter
    return (
        row.title + ("" if row.converged else " *"),
        str(row.parameters),
        f"{row.rmse:.4f}",
        f"{100 * row.rmse_share:.2f}",
        _number(row.aic, ".1f"),
        _number(row.bic, ".1f"),
        _number(row.held_out_rmse, ".4f"),
        _number(100 * row.first_rmse_share, ".2f"),
        _number(row.first_aic, ".1f"),
        "-" if shake is None else f"{1e3 * shake.rest:.1f}",
        "-" if shake is None else f"{1e3 * shake.hand:.1f}",
    )


def _number(value: float, form: str) -> str:
    return format(value, form) if math.isfinite(value) else "-"


def notes(comparison: TraceComparison) -> list[str]:
    """What the reader of the table must know."""
    found = [
        f"{len(comparison.trace)} samples, peak {comparison.peak:.3g} N. Neighbouring residuals are alike: AIC and BIC "
        f"count {comparison.effective_samples:.0f} independent samples."
    ]
    if any(not math.isfinite(row.aic) for row in comparison.rows):
        found.append("AIC -: the model has more numbers than the trace has independent samples.")
    if any(not row.converged for row in comparison.rows):
        found.append("*: the fit ended at its limit of steps, not at an optimum.")
    if not any(row.scene for row in comparison.rows):
        found.append(
            "K06 is not in the table: it needs the needle (--needle diameter_mm=...,tip_angle_deg=...; a recording has "
            "its own), and the name k06 where --models names some."
        )
    alone = [row.title for row in comparison.rows if row.starts > 1 and row.agreeing == 1]
    if alone:
        found.append(f"Only one start led to the best fit, so there may be a better one: {', '.join(alone)}.")
    return found


def as_json(comparison: TraceComparison) -> ComparisonRecord:
    """The numbers of the table in SI, for programs; None for what has no value."""
    return {
        "trace": comparison.trace.source,
        "samples": len(comparison.trace),
        "peak_N": comparison.peak,
        "effective_samples": comparison.effective_samples,
        "models": [_entry(row) for row in comparison.rows],
        "notes": notes(comparison),
    }


def _entry(row: Row) -> ModelRecord:
    return {
        "name": row.name,
        "title": row.title,
        "parameters": row.parameters,
        "rmse_N": row.rmse,
        "rmse_share_of_peak": row.rmse_share,
        "aic": _finite(row.aic),
        "bic": _finite(row.bic),
        "held_out_rmse_N": _finite(row.held_out_rmse),
        "first_stretch_rmse_share": _finite(row.first_rmse_share),
        "first_stretch_aic": _finite(row.first_aic),
        "chatter_rest_N": None if row.chatter is None else row.chatter.rest,
        "chatter_hand_N": None if row.chatter is None else row.chatter.hand,
        "converged": row.converged,
        "starts": row.starts,
        "starts_that_agree": row.agreeing,
        "layers": [{"surface_m": one.surface, "numbers": one.rival.numbers} for one in row.layers],
    }


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None
