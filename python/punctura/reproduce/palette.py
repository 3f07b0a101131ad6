"""The colours of figures and page: the colour-blind-safe palette of Okabe and Ito (2008), with a dark variant."""

from typing import NamedTuple


class Colour(NamedTuple):
    """A named colour. Image files use the light variant. The page uses the dark one if the reader prefers dark mode."""

    name: str
    light: str
    dark: str


PAGE = Colour("page", "#ffffff", "#15181c")
INK = Colour("ink", "#1b1f24", "#e8eaed")
MUTED = Colour("muted", "#5f6670", "#a2a9b3")
GRID = Colour("grid", "#e6e8eb", "#2b3036")
GUIDE = Colour("guide", "#d3d8de", "#474e57")
BAND = Colour("band", "#eaf0f5", "#212a33")

INSERTION = Colour("insertion", "#0072b2", "#56b4e9")
WITHDRAWAL = Colour("withdrawal", "#d55e00", "#f0883e")
STICKING = Colour("sticking", "#70757d", "#9aa1ab")
PAPER_FORM = Colour("paper-form", "#cc79a7", "#e292bf")

# The three coefficients of friction of Fig. 3, and the five thicknesses of Fig. 5, thinnest first, dark to bright.
FRICTIONS = (
    Colour("friction-1", "#009e73", "#2fc79b"),
    Colour("friction-2", "#0072b3", "#56b4ea"),
    Colour("friction-3", "#d55e01", "#f0883f"),
)
THICKNESSES = (
    Colour("thickness-1", "#3b0f70", "#fde0a1"),
    Colour("thickness-2", "#8c2981", "#fe9f6d"),
    Colour("thickness-3", "#c43c75", "#e4568a"),
    Colour("thickness-4", "#ed6a4e", "#b24fb0"),
    Colour("thickness-5", "#e8a33d", "#8a7fe0"),
)

ALL = (
    PAGE, INK, MUTED, GRID, GUIDE, BAND, INSERTION, WITHDRAWAL, STICKING, PAPER_FORM, *FRICTIONS, *THICKNESSES,
)  # fmt: skip
