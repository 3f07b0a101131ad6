"""The page of figures, one file, usable offline, light and dark, and the figures' data as CSV."""

import platform
import re
from collections.abc import Sequence
from html import escape
from importlib.metadata import version
from importlib.resources import files
from pathlib import Path
from typing import NamedTuple

import numpy as np

from punctura import __version__
from punctura._core import Hand, Plant
from punctura.reproduce import palette
from punctura.reproduce.experiment import (
    COUNT,
    DURATION_S,
    REST_S,
    SEED,
    START_MM,
    STROKE_DEPTH_MM,
    VARIATION,
    k06_scene,
)
from punctura.reproduce.style import Drawing, Measured, Table, read_words

_K06 = "K06 section 4"
_OMNI = "maker's data sheet"
_CHOICE = "chosen here"


class Parameter(NamedTuple):
    """A row of the page's table."""

    group: str
    name: str
    value: str
    source: str


def parameters() -> list[Parameter]:
    """The parameters of Figs. 5 and 10 to 12."""
    scene, plant, hand = k06_scene("k06-fig10"), Plant(), Hand()
    depths = " / ".join(f"{depth:g}" for depth in STROKE_DEPTH_MM.values()) + " mm"
    membrane = scene.membranes[0].membrane
    return [
        Parameter("needle", "diameter w", f"{scene.needle.diameter * 1e3:g} mm", _K06),
        Parameter("needle", "tip angle θ", f"{scene.needle.tip_angle:g} rad", _K06),
        Parameter("membrane", "stiffness κ", f"{membrane.stiffness * 1e-3:g} N/mm", _K06),
        Parameter("membrane", "precompression c", f"{membrane.precompression:g} N", _K06),
        Parameter("membrane", "friction μ", f"{membrane.friction:g}", _K06),
        Parameter("coupling", "stiffness K", f"{scene.coupling.stiffness * 1e-3:g} N/mm", _K06),
        Parameter("coupling", "damping B", f"{scene.coupling.damping * 1e-3:g} N s/mm", _K06),
        Parameter("servo loop", "rate 1/T", f"{scene.servo.rate:g} Hz", _K06),
        Parameter("servo loop", "low-pass on the position", f"{scene.servo.low_pass:g} Hz", _K06),
        Parameter("device", "apparent mass", f"{plant.mass * 1e3:g} g", _OMNI),
        Parameter("device", "dry friction", f"{plant.friction:g} N", _OMNI),
        Parameter("device", "encoder step", f"{plant.encoder_step * 1e3:g} mm", _OMNI),
        Parameter("device", "largest force", f"{plant.max_force:g} N", _OMNI),
        Parameter("hand", "mass", f"{hand.mass * 1e3:g} g", "illustrative"),
        Parameter("hand", "stiffness", f"{hand.stiffness * 1e-3:g} N/mm", "illustrative"),
        Parameter("hand", "damping", f"{hand.damping * 1e-3:g} N s/mm", "illustrative"),
        Parameter("hand", "tremor", f"{hand.tremor_rms * 1e3:g} mm rms at {hand.tremor_hz:g} Hz", "illustrative"),
        Parameter("strokes", "count, one way, rest", f"{COUNT}, {DURATION_S:g} s, {REST_S:g} s", _CHOICE),
        Parameter("strokes", "start, distance from the membrane", f"{START_MM:g} mm", _CHOICE),
        Parameter("strokes", "desired depth, Figs. 10 / 11 / 12", depths, _CHOICE),
        Parameter("strokes", "standard deviation of depth and time", f"{VARIATION * 100:g} %", _CHOICE),
        Parameter("strokes", "seed", f"{SEED}", _CHOICE),
    ]


def versions() -> dict[str, str]:
    """Name and version of the software that affects numbers and pictures."""
    return {
        "punctura": __version__,
        "python": platform.python_version(),
        "numpy": version("numpy"),
        "matplotlib": version("matplotlib"),
        "system": f"{platform.system()} {platform.machine()}",
    }


def write_csv(table: Table, path: Path) -> None:
    """One row per sample. Numbers have the shortest form that reads back identically. NaN is an empty cell."""
    columns = [_cells(column) for column in table.values()]
    lines = [",".join(table), *map(",".join, zip(*columns, strict=True))]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8", newline="\n")


def _cells(column: object) -> list[str]:
    array = np.asarray(column)
    if array.dtype.kind == "f":
        return ["" if x != x else repr(x) for x in array.tolist()]
    return [str(x) for x in array.tolist()]


def inline_svg(svg: str, name: str, alt: str) -> str:
    """The <svg> element. The page's style sheet must define `--colour-…` for every colour of the palette."""
    body = svg[svg.index("<svg") :]
    body = re.sub(r"<metadata>.*?</metadata>", "", body, flags=re.DOTALL)
    body = re.sub(r'<style type="text/css">.*?</style>', "", body, flags=re.DOTALL)
    body = re.sub(r'\bid="([^"]+)"', rf'id="{name}-\1"', body)
    body = re.sub(r"url\(#([^)]+)\)", rf"url(#{name}-\1)", body)
    body = re.sub(r'href="#([^"]+)"', rf'href="#{name}-\1"', body)
    for colour in palette.ALL:
        body = body.replace(colour.light, f"var(--colour-{colour.name})")
    # The page sets the size. The view box keeps the aspect ratio.
    body = re.sub(r'(<svg[^>]*?) width="[^"]*"', r"\1", body, count=1)
    body = re.sub(r'(<svg[^>]*?) height="[^"]*"', r"\1", body, count=1)
    return body.replace("<svg", f'<svg class="figure" role="img" aria-label="{alt}"', 1)


def colour_rules() -> str:
    """The palette as CSS, light and dark."""
    light = "".join(f"--colour-{c.name}:{c.light};" for c in palette.ALL)
    dark = "".join(f"--colour-{c.name}:{c.dark};" for c in palette.ALL)
    return f":root{{color-scheme:light dark;{light}}}\n@media (prefers-color-scheme:dark){{:root{{{dark}}}}}\n"


def write_page(drawings: Sequence[Drawing], folder: Path, name: str) -> None:
    """Writes the page. The files of the drawings must already be in `folder`."""
    words = read_words("page")
    sections = "\n".join(_section(drawing, folder) for drawing in drawings)
    links = [(d.name, d.words.title.split(":")[0]) for d in drawings] + [
        ("numbers", "Numbers"),
        ("parameters", "Parameters"),
    ]
    nav = "".join(f'<a href="#{anchor}">{escape(text)}</a>' for anchor, text in links)
    css = files("punctura.reproduce").joinpath("page.css").read_text(encoding="utf-8")
    made_with = ", ".join(f"{escape(what)} {escape(which)}" for what, which in versions().items() if what != "system")
    html = f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<title>{escape(words.title)}</title>
<style>
{colour_rules()}{css}</style>
</head>
<body>
<header>
<h1>{escape(words.title)}</h1>
{_paragraphs(words.text)}
<nav>{nav}</nav>
</header>
<main>
{sections}
{_numbers([m for d in drawings for m in d.measured])}
{_parameters()}
</main>
<footer><p>Made by <code>punctura reproduce</code> with {made_with}, on {escape(versions()["system"])}.
The same seed gives the same numbers.</p></footer>
</body>
</html>
"""
    (folder / name).write_text(html, encoding="utf-8")


def _section(drawing: Drawing, folder: Path) -> str:
    svg = (folder / f"{drawing.name}.svg").read_text(encoding="utf-8")
    picture = inline_svg(svg, drawing.name, escape(drawing.words.alt, quote=True))
    names = [f"{drawing.name}.png", f"{drawing.name}.svg", *(f"{table}.csv" for table in drawing.tables)]
    links = "".join(f'<a href="{escape(name)}">{escape(name)}</a>' for name in names)
    return f"""<section id="{drawing.name}">
<h2>{escape(drawing.words.title)}</h2>
<figure>{picture}</figure>
{_paragraphs(drawing.words.text)}
<div class="files">{links}</div>
</section>"""


def _paragraphs(text: Sequence[str]) -> str:
    return "\n".join(f"<p>{escape(paragraph)}</p>" for paragraph in text)


def _numbers(measured: Sequence[Measured]) -> str:
    rows = "\n".join(
        f"<tr><td>{escape(m.figure)}</td><td>{escape(m.quantity)}</td>"
        f'<td class="number">{_number(m.expected, m.unit)}</td><td class="number">{_number(m.measured, m.unit)}</td>'
        f"<td>{escape(m.source)}</td></tr>"
        for m in measured
    )
    return f"""<section id="numbers">
<h2>Measured in this run, and expected</h2>
<p>The expected value is the law's value for an infinitely slow needle. A run samples the law once per tick, so its
peaks are slightly lower.</p>
<div class="wide"><table>
<thead><tr><th>figure</th><th>quantity</th><th class="number">expected</th><th class="number">measured</th>
<th>expected from</th></tr></thead>
<tbody>
{rows}
</tbody></table></div>
</section>"""


def _number(value: float, unit: str) -> str:
    if value != value:
        return ""
    return f"{value:.0f}" if not unit else f"{value:.4f} {unit}"


def _parameters() -> str:
    rows = "\n".join(
        f'<tr><td>{escape(p.group)}</td><td>{escape(p.name)}</td><td class="number">{escape(p.value)}</td>'
        f"<td>{escape(p.source)}</td></tr>"
        for p in parameters()
    )
    return f"""<section id="parameters">
<h2>Parameters</h2>
<div class="wide"><table>
<thead><tr><th>group</th><th>parameter</th><th class="number">value</th><th>source</th></tr></thead>
<tbody>
{rows}
</tbody></table></div>
</section>"""
