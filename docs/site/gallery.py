"""The gallery: runs each numbered example and draws its picture from the results.

The pictures are made at every build and committed nowhere, because that is cheap: some 20 s, of which 5 s are those of
the two examples that run in real time.
"""

import contextlib
import io
import os
import re
import runpy
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
from layout import ROOT
from matplotlib.axes import Axes
from punctura import live

EXAMPLES = ROOT / "examples"
INKS = {"light": "#1f2328", "dark": "#d8dee4"}
LINE = "#2f81f7"
RUNTIME = ROOT / "runtime"
# What an example in C++ needs of the runtime, on the system that builds the documentation.
SOURCES = (
    *(f"os/{name}.cpp" for name in ("linux", "posix_library", "socket")),
    *("loop/servo_loop.cpp", "loop/end_of_run.cpp", "loop/thumb_loop.cpp"),
    *("backends/polled_device.cpp", "backends/simulated.cpp"),
    "batch/blocks.cpp",
)
PEAK = re.compile(r"rest +([\d.]+) s +second peak +([\d.]+) N")
PRINTED = re.compile(r"(?:depth|y) +(-?[\d.]+) mm +force +(-?[\d.]+) N")


class Run:
    """The results of an example: its variables, its output, the ticks of its servo loops."""

    def __init__(self, variables: dict[str, Any], output: str, ticks: list[Any]) -> None:
        self.variables, self.output, self.ticks = variables, output, ticks

    def __getitem__(self, name: str) -> Any:
        return self.variables[name]


def run_python(path: Path) -> Run:
    """Runs an example in this process and listens to every servo loop that it starts."""
    printed_text, listeners = io.StringIO(), []
    start = live.ServoLoop.start

    def start_and_listen(loop: live.ServoLoop, duration: float | None = None) -> None:
        listeners.append(loop.listen())
        start(loop, duration)

    live.ServoLoop.start = start_and_listen  # type: ignore[method-assign]
    try:
        with contextlib.redirect_stdout(printed_text):
            variables = runpy.run_path(str(path), run_name="__main__")
        return Run(variables, printed_text.getvalue(), [listener.read() for listener in listeners])
    finally:
        live.ServoLoop.start = start  # type: ignore[method-assign]


def run_cpp(path: Path, folder: Path) -> Run:
    """Runs an example that ./test has compiled (PUNCTURA_EXAMPLES: in which folder), or compiles it here."""
    built = Path(os.environ.get("PUNCTURA_EXAMPLES", folder), path.stem)
    program = built if built.exists() else compiled(path, (folder / path.stem).resolve())
    with TemporaryDirectory() as own:  # for the files that it writes
        output = subprocess.run([program], check=True, capture_output=True, text=True, cwd=own).stdout
    if program is not built:
        program.unlink()
    return Run({}, output, [])


def compiled(path: Path, program: Path) -> Path:
    command = [os.environ.get("CXX", "c++"), "-std=c++20", "-ffp-contract=off", f"-I{ROOT / 'core'}", path]
    if "punctura_runtime" in path.read_text(encoding="utf-8"):
        command += [f"-I{RUNTIME}", "-pthread", *(RUNTIME / "punctura_runtime" / source for source in SOURCES)]
    subprocess.run([*command, "-o", program, "-ldl"], check=True)
    return program


def depth_and_force(axes: Axes, depth: Any, force: Any, style: str = "-") -> None:
    axes.plot(np.asarray(depth), np.asarray(force), style, color=LINE, lw=1.5, ms=4)
    axes.set(xlabel="depth of the tip, mm", ylabel="force on the device, N")


def pop(axes: Axes, run: Run) -> None:
    depth_and_force(axes, run["depth"] * 1e3, run["ticks"].force)


def two_walls(axes: Axes, run: Run) -> None:
    along = (run["tip"] - run["tip"][0]) @ run["axis"]
    depth_and_force(axes, along * 1e3, run["trace"].force @ run["axis"])
    axes.set(xlabel="way of the tip along the needle, mm", ylabel="force along the needle, N")


def experiment(axes: Axes, run: Run) -> None:
    trace = run["trace"]
    depth_and_force(axes, -trace.position[:, 1] * 1e3, trace.force[:, 1])
    axes.set(ylabel="force on the device, upwards, N")


def printed(axes: Axes, run: Run) -> None:
    depth_and_force(axes, *np.array(PRINTED.findall(run.output), float).T, "o-")


def servo_loop(axes: Axes, run: Run) -> None:
    [ticks] = run.ticks
    time = ticks.time - ticks.time[0]
    axes.plot(time, ticks.force[:, 1], color=LINE, lw=1.5)
    axes.set(xlabel="time, s", ylabel="force on the device, upwards, N")


def healing(axes: Axes, run: Run) -> None:
    axes.plot(*np.array(PEAK.findall(run.output), float).T, "o-", color=LINE, lw=1.5, ms=4)
    axes.set(xlabel="rest between two insertions, s", ylabel="peak of the second one, N", ylim=(0, None))


def band(axes: Axes, run: Run) -> None:
    for edge in ("lower", "upper"):
        depth_and_force(axes, run["depth"] * 1e3, run[edge])


def solvers(axes: Axes, run: Run) -> None:
    for name, style in (("paper", "-"), ("exact", "--")):
        depth_and_force(axes, run["depth"] * 1e3, run["forces"][name], style)
        axes.lines[-1].set(color=LINE if name == "exact" else "#db6d28", label=name)
    axes.legend(frameon=False)


def measured(axes: Axes, run: Run) -> None:
    depth_and_force(axes, run["depth"] * 1e3, run["force"])
    axes.set(xlabel="position, mm", ylabel="force on the sensor, N")


def study(axes: Axes, run: Run) -> None:
    friction, hand, peak = (np.array(run.variables[name]) for name in ("friction", "stiffness", "peaks"))
    for value in np.unique(friction):
        axes.plot(hand[friction == value], peak[friction == value], "o-", ms=4, lw=1.5, label=f"friction {value:g}")
    axes.set(xlabel="stiffness of the hand, N/m", ylabel="peak, N")
    axes.legend(frameon=False, fontsize=7)


def learnt(axes: Axes, run: Run) -> None:
    axes.plot(100 * np.array(run["curve"]), "o-", color=LINE, lw=1.5, ms=4)
    axes.set(xlabel="generation", ylabel="trials that stop\nbehind the pop, %", ylim=(0, 103))


PICTURES: dict[str, Callable[[Axes, Run], None]] = {
    "01_pop": pop,
    "02_scene": two_walls,
    "03_simulated_device": experiment,
    "04_own_law": printed,
    "05_servo_loop": servo_loop,
    "06_own_device": servo_loop,
    "07_measured_tissue": printed,
    "08_healing_law": healing,
    "09_law_and_band": band,
    "10_solvers": solvers,
    "11_identify": measured,
    "12_study": study,
    "13_learn": learnt,
}


def draw(run: Run, stem: str, folder: Path) -> None:
    """One picture for light pages and one for dark ones."""
    for theme, ink in INKS.items():
        colours = dict.fromkeys(("text.color", "axes.labelcolor", "axes.edgecolor", "xtick.color", "ytick.color"), ink)
        with plt.rc_context({**colours, "svg.hashsalt": "punctura", "font.size": 9}):
            figure, axes = plt.subplots(figsize=(6.4, 2.8), layout="constrained")
            PICTURES[stem](axes, run)
            axes.grid(alpha=0.25)
            axes.spines[["top", "right"]].set_visible(False)
            figure.savefig(folder / f"{stem}-{theme}.svg", transparent=True, metadata={"Date": None})
            plt.close(figure)


def write(folder: Path) -> None:
    """Runs every numbered example and writes the gallery's page and pictures."""
    matplotlib.use("agg")
    folder.mkdir(parents=True, exist_ok=True)
    lines = [
        "# Gallery of examples",
        "",
        "The numbered [examples](../examples/README.md). The pictures were drawn from their results at this build.",
        "",
    ]
    titles = dict(re.findall(r"^\| (\d\d) \| (.*?) \|", (EXAMPLES / "README.md").read_text(encoding="utf-8"), re.M))
    for stem in sorted({path.stem for path in EXAMPLES.glob("*/[0-9][0-9]_*.*")}):
        python, cpp = EXAMPLES / "python" / f"{stem}.py", EXAMPLES / "cpp" / f"{stem}.cpp"
        if stem not in PICTURES:
            sys.exit(f"example {stem} has no picture: add a function for it to PICTURES in docs/site/gallery.py")
        draw(run_python(python) if python.exists() else run_cpp(cpp, folder), stem, folder)
        words = re.sub(r": \[.*$", "", titles[stem[:2]])
        lines += [f"## {stem[:2]} {words[0].upper()}{words[1:]}", ""]
        lines += [f"![Force of example {stem}]({stem}-{theme}.svg){{.only-{theme}}}" for theme in INKS]
        for language, path in (("python", python), ("cpp", cpp)):
            if path.exists():
                title = f"{'Python' if language == 'python' else 'C++'}: examples/{path.parent.name}/{path.name}"
                lines += [
                    "",
                    f"<details><summary>{title}</summary>",
                    "",
                    f"```{{literalinclude}} ../examples/{path.parent.name}/{path.name}",
                    f":language: {language}",
                    "```",
                    "",
                    "</details>",
                    "",
                ]
    (folder / "index.md").write_text("\n".join(lines), encoding="utf-8")
