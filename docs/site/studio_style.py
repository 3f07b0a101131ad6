"""The generated page that shows the studio's colours, letters and spaces, read from its style sheet."""

import re
from collections.abc import Iterator
from html import escape
from typing import NamedTuple

from layout import ROOT

TOKENS = ROOT / "web" / "src" / "styles" / "tokens.css"
TOKEN = re.compile(r"^  --([\w-]+): (.+); /\* (.+) \*/$", re.M)
PAIR = re.compile(r"light-dark\((#\w+), (#\w+)\)")


class Token(NamedTuple):
    name: str
    value: str
    use: str


def tokens() -> list[Token]:
    return [Token(*found) for found in TOKEN.findall(TOKENS.read_text(encoding="utf-8"))]


def shown(style: str, text: str = "") -> str:
    return f'<span style="{escape(style)}">{text}</span>'


def rows(kind: list[Token], example: str, style: str) -> Iterator[str]:
    """A table of tokens with an example each. style: of the example; {} is the token's value."""
    yield f"| name | {example} | value | for |"
    yield "|---|---|---|---|"
    for name, value, use in kind:
        text = "Push until it gives. 0.32 N" if example == "letters" else ""
        yield f"| `--{name}` | {shown(style.format(value), text)} | `{value}` | {use} |"
    yield ""


def page() -> str:
    """Colours in both schemes, letters in their sizes, spaces and corners in theirs."""
    left = tokens()
    colours = [(token, pair) for token in left if (pair := PAIR.fullmatch(token.value))]
    letters = [token for token in left if token.name.startswith("type-")]
    faces = [token for token in left if "monospace" in token.value]
    corners = [token for token in left if token.name.startswith("radius")]
    known = {token.name for token in [*letters, *faces, *corners, *(token for token, _ in colours)]}
    spaces = [token for token in left if token.name not in known]
    patch = "display:inline-block;width:3em;height:1.3em;vertical-align:middle;border:1px solid #888;background:{}"
    lines = [
        "# The studio's style",
        "",
        "Every colour, size of letters, space and corner of [the studio's page](../docs/studio.md) has a name in its",
        "style sheet, `web/src/styles/tokens.css`. These tables are made from that file.",
        "",
        "## Colours",
        "",
        "| name | light | dark | for |",
        "|---|---|---|---|",
    ]
    for token, pair in colours:
        light, dark = (f"{shown(patch.format(colour))} `{colour}`" for colour in pair.groups())
        lines.append(f"| `--{token.name}` | {light} | {dark} | {token.use} |")
    lines += [
        "",
        "The colours of the data differ from each other for colour-blind people, too, and stand out from the panels.",
        "",
        "## Letters",
        "",
        "On the stage the letters grow with the window: `vmin` is a hundredth of its shorter side.",
        "",
        *rows(letters, "letters", "font-size:{};line-height:1.2"),
        *rows(faces, "letters", "font-family:{}"),
        "## Spaces and corners",
        "",
        *rows(spaces, "space", "display:inline-block;height:1em;background:#2f81f7;width:{}"),
        *rows(corners, "corner", "display:inline-block;width:4em;height:2em;border:2px solid #2f81f7;border-radius:{}"),
    ]
    return "\n".join(lines)
