"""The one-page report of an identification: trace, fit, residuals, profile, models, and what the data cannot tell."""

import base64
import io
from html import escape
from typing import Any

import numpy as np

from punctura.extras import optional
from punctura.files.names import as_text
from punctura.identify.doubts import NOT_EXPLAINED
from punctura.identify.identify import Identification
from punctura.identify.records import IdentificationRecord

_STYLE = (
    "body{font:15px/1.45 system-ui,sans-serif;max-width:62em;margin:2em auto;padding:0 1em;color:#222}"
    "table{border-collapse:collapse}td,th{padding:.15em .8em;border-bottom:1px solid #ddd;text-align:right}"
    "td:first-child,th:first-child{text-align:left}.no{color:#a40000}img{width:100%}"
)


def report_html(found: Identification) -> bytes:
    """The report as one HTML file without references to others."""
    record = found.as_dict()
    picture = base64.b64encode(picture_png(found)).decode()
    findings = "".join(f"<li>{escape(str(f))}</li>" for f in found.trace.findings) or "<li>nothing unusual</li>"
    doubts = "".join(f"<li>{escape(text)}</li>" for text in found.verdicts) or "<li>nothing: all is identifiable</li>"
    head = (
        f"{record['membranes']} membrane(s), {', '.join(record['extensions']) or 'K06 without extensions'}; rms error "
        f"{record['rmse_N']:.3g} N, {100 * record['rmse_share_of_peak']:.2g} % of the greatest force; "
        f"{record['samples']} samples, as many as {record['effective_samples']:.0f} independent ones"
        f"{'' if found.doubts.whole else f'; {NOT_EXPLAINED}'}"
    )
    page = (
        f"<!doctype html><html lang=en><meta charset=utf-8><title>Identification</title><style>{_STYLE}</style>"
        f"<h1>Membranes of {escape(as_text(found.trace.source) or 'a trace')}</h1><p>{escape(head)}.</p>"
        f'<img alt="Force against depth, residuals, law of each membrane" src="data:image/png;base64,{picture}">'
        f"<h2>Parameters, with 95 % intervals</h2>{_parameters(record)}"
        f"<h2>What the trace cannot tell, and which experiment would</h2><ul>{doubts}</ul>"
        f"<h2>Found in the trace</h2><ul>{findings}</ul><h2>Models that were tried</h2>{_models(record)}"
        f"<p>The intervals hold if the model is right. Residuals with a shape say that it is not.</p></html>"
    )
    return page.encode()


def _parameters(record: IdentificationRecord) -> str:
    rows = []
    for p in record["parameters"]:
        low, high = ("?" if bound is None else f"{bound:.4g}" for bound in (p["low"], p["high"]))
        mark = "" if p["identifiable"] else " class=no"
        note = "" if p["identifiable"] else "not identifiable"
        rows.append(
            f"<tr{mark}><td>{escape(p['name'])}<td>{p['value']:.4g}<td>{low}<td>{high}<td>{p['unit']}<td>{note}"
        )
    return f"<table><tr><th>parameter<th>value<th>low<th>high<th>unit<th>{''.join(rows)}</table>"


def _models(record: IdentificationRecord) -> str:
    rows = []
    for m in record["models"]:
        held_out = "-" if m["held_out_rmse_N"] is None else f"{m['held_out_rmse_N']:.3g}"
        aicc = "-" if m["aicc"] is None else f"{m['aicc']:.0f}"
        name = " + ".join(m["extensions"]) or "K06"
        rows.append(f"<tr><td>{escape(name)}<td>{m['membranes']}<td>{m['parameters']}<td>{m['rmse_N']:.3g}"
                    f"<td>{held_out}<td>{aicc}<td>{m['bic']:.0f}")  # fmt: skip
    head = "<tr><th>model<th>membranes<th>parameters<th>rms, N<th>held out, N<th>AICc<th>BIC"
    return (
        f"<table>{head}{''.join(rows)}</table><p>The first one was chosen. The criteria count independent samples.</p>"
    )


def picture_png(found: Identification) -> bytes:
    """Trace and fit, residuals, and the law of each membrane."""
    optional("matplotlib", "identify", "a report")
    from matplotlib.figure import Figure

    figure = Figure(figsize=(11, 8), layout="constrained")
    over, below, law = figure.subplots(3, 1, height_ratios=(3, 1.2, 2))
    depth = found.trace.depth * 1e3
    model = found.fit.misfit.forces(found.parameters)
    over.plot(depth, found.trace.force, ".", color="0.55", ms=3, label="measured")
    over.plot(depth, model, color="C3", lw=1.2, label="model")
    for pop in found.segments.pops:
        over.axvline(pop.depth * 1e3, color="0.8", lw=0.8, zorder=0)
    over.set(ylabel="force, N", title="shaded: not explained" if found.doubts.explained.places else "")
    over.legend()
    for place in found.doubts.explained.places:
        for axes in (over, below):
            axes.axvspan(place.shallow * 1e3, place.deep * 1e3, color="C1", alpha=0.25, lw=0, zorder=0)
    below.plot(depth, model - found.trace.force, color="C0", lw=0.8)
    below.set(xlabel="depth, mm", ylabel="model - measured, N")
    _draw_laws(law, found)
    for axes in (over, below, law):
        axes.grid(alpha=0.3)
    data = io.BytesIO()
    figure.savefig(data, format="png", dpi=110)
    return data.getvalue()


def _draw_laws(axes: Any, found: Identification) -> None:
    """The force of each membrane alone, for a stiff coupling: in, and out again."""
    from punctura._core import TraceModel

    p = found.parameters
    pops, _ = TraceModel.pop_depths(p.needle, p.membranes, p.coupling)
    reach = 1.6 * float(np.max(pops))
    way = np.concatenate((np.linspace(-0.05 * reach, reach, 600), np.linspace(reach, -0.05 * reach, 600)))
    coupling = p.coupling.copy()
    coupling[:2] = 1e6, 0
    for i, row in enumerate(p.membranes):
        alone = row.copy()
        alone[0] = 0.0
        force, _ = TraceModel(p.needle, way).forces([alone], coupling, False)
        axes.plot(way * 1e3, force, lw=1, label=f"membrane {i + 1}")
    axes.set(xlabel="depth behind the surface, mm", ylabel="resistance, N")
    axes.legend()
