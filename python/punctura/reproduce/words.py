"""The words beside each figure: words/NAME.txt holds the title, the picture in a sentence, and paragraphs."""

from __future__ import annotations

from dataclasses import dataclass
from importlib.resources import files


@dataclass(frozen=True)
class Words:
    """What is said about a figure."""

    title: str
    alt: str  # the picture in a sentence, for those who cannot see it
    text: tuple[str, ...]  # paragraphs: what to look for, and how it relates to the paper


def read_words(name: str, **numbers: float) -> Words:
    """The words of a figure, with `numbers` put in where the text names them."""
    raw = files("punctura.reproduce").joinpath("words", f"{name}.txt").read_text(encoding="utf-8")
    title, alt, *text = (part.strip().format(**numbers) for part in raw.strip().split("\n\n"))
    return Words(title, alt, tuple(text))
