"""Draws docs/images/measured-tissue.svg, the picture of docs/measured-tissue.md: what each addition does to the force.

python tools/tissue_pictures.py
"""

from pathlib import Path

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
import punctura as pn
from matplotlib.axes import Axes
from numpy.typing import NDArray
from punctura._core import TraceModel
from validation_pictures import save

PICTURE = Path(__file__).resolve().parents[1] / "docs/images/measured-tissue.svg"
NEEDLE = pn.Needle(diameter=1.27e-3, tip_angle=0.3)
K06 = {"stiffness": 400.0, "precompression": 0.1, "friction": 0.2, "thickness": 0.5e-3, "tail_floor": 1.0}
PLAIN, CHANGED = "#8c959f", "#2f81f7"
KNOTS = [  # an example: depth in m, force in N
    (0, 0.1), (0.8e-3, 0.45), (1.6e-3, 0.72), (2.4e-3, 0.86), (3e-3, 0.88), (3.6e-3, 0.72), (4.6e-3, 0.48),
    (5.6e-3, 0.4),
]  # fmt: skip
PANELS = [
    ("grip that grows faster", {"growth": 900.0}, 1),
    ("tip length 2.6 mm", {"tip_length": 2.6e-3}, 1),
    ("tail of 2 mm down to 40 %", {"tail_length": 2e-3, "tail_floor": 0.4}, 1),
    ("cutting 0.3 N: first, second insertion", {"cutting": 0.3}, 2),
    ("set 30 %: first, second insertion", {"set": 0.3}, 2),
]


def motion(insertions: int) -> NDArray[np.float64]:
    """Strokes at 5 mm/s to 9 mm and back, sampled at 1600 Hz, m."""
    way = np.arange(-1e-3, 9e-3, 5e-3 / 1600)
    return np.tile(np.concatenate([way, way[::-1]]), insertions)


def force(depth: NDArray[np.float64], **values: float) -> NDArray[np.float64]:
    """The force that resists insertion, N."""
    numbers = dict.fromkeys(TraceModel.membrane_names, 0.0) | K06 | values
    model = TraceModel(NEEDLE, depth, np.arange(len(depth)) / 1600)
    coupling = [4000.0, 1.0, 0, 1, 0, 1]
    return model.forces([[numbers[name] for name in TraceModel.membrane_names]], coupling, False)[0]


def strokes(axes: Axes, depth: NDArray[np.float64], forces: NDArray[np.float64], colour: str, label: str) -> None:
    """Draws each insertion and withdrawal: the first with a line, the second dashed."""
    each = len(motion(1))
    for i in range(0, len(depth), each):
        part = slice(i, i + each)
        name = label if i == 0 else f"{label}, again"
        axes.plot(depth[part] * 1e3, forces[part], "-" if i == 0 else "--", color=colour, lw=1.3, label=name)


def profile(axes: Axes) -> None:
    depths, values = np.array(KNOTS).T
    law = pn.ProfileLaw(depths, -values, 0.4 * values, K06["thickness"])
    depth = motion(1)
    proxy = pn.Proxy1d(law, pn.Coupling(4000, 1), 1 / 1600)
    strokes(axes, depth, -proxy.run(depth).force, CHANGED, "profile")
    axes.plot(depths * 1e3, values, "o", color=CHANGED, ms=3, label="its knots, thin")
    axes.set_title("a profile of 8 knots", fontsize=9)


def main() -> None:
    matplotlib.use("agg")
    with plt.rc_context({"svg.hashsalt": "punctura", "font.size": 8}):
        figure, all_axes = plt.subplots(2, 3, figsize=(9, 5), sharex=True, sharey=True, layout="constrained")
        for axes, (title, values, insertions) in zip(all_axes.flat, PANELS, strict=False):
            depth = motion(insertions)
            strokes(axes, motion(1), force(motion(1)), PLAIN, "K06")
            strokes(axes, depth, force(depth, **values), CHANGED, "changed")
            axes.set_title(title, fontsize=9)
        profile(all_axes.flat[-1])
        for axes in all_axes.flat:
            axes.grid(alpha=0.25)
            axes.spines[["top", "right"]].set_visible(False)
            axes.legend(fontsize=7, frameon=False)
        figure.supxlabel("depth of the tip, mm", fontsize=9)
        figure.supylabel("force that resists insertion, N", fontsize=9)
        save(figure, PICTURE)
        plt.close(figure)


if __name__ == "__main__":
    main()
