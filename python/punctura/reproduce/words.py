"""The text of each figure. words/NAME.txt holds the title, an alternative text, and paragraphs."""

from __future__ import annotations

from dataclasses import dataclass
from importlib.resources import files


@dataclass(frozen=True)
class Words:
    """The text of a figure."""

    title: str
    alt: str  # alternative text: the picture in one sentence
    text: tuple[str, ...]  # paragraphs: what to look for, and the relation to the paper


def read_words(name: str, **numbers: float) -> Words:
    """The text of a figure. `numbers` fill the named placeholders."""
    raw = files("punctura.reproduce").joinpath("words", f"{name}.txt").read_text(encoding="utf-8")
    title, alt, *text = (part.strip().format(**numbers) for part in raw.strip().split("\n\n"))
    return Words(title, alt, tuple(text))
