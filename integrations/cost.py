"""Measures the cost of a tick on each way into Punctura, in one run, and writes the table of docs/which-way-in.md.

    python integrations/cost.py [--write]

A way whose tool chain is missing is left out and named. All ways run the motion of reference.py: two membranes, the
exact solver. Each way is measured in three rounds, far apart, of many short runs. The shortest run counts, because
other programs of the machine can only add time. For the ways of Python, the time of the processor counts, so that the
runs of other programs in between do not.
"""

from __future__ import annotations

import argparse
import datetime
import os
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import punctura as pn
from punctura.fmu import export_fmu
from punctura.poses import PosedNeedle

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent
ROUNDS = 3
WORK = ROOT / "build/integrations/cost"
PAGE = ROOT / "docs/which-way-in.md"
BEGIN, END = "<!-- costs: integrations/cost.py --write -->\n", "<!-- end of the costs -->\n"


def run(script: str) -> str:
    """Runs lines of bash behind integrations/tools.sh. Returns what they print."""
    lines = f'source "{HERE}/tools.sh"\nbuild_library >&2\n{script}'
    command = ["bash", "-c", lines, str(HERE / "c/test.sh")]
    done = subprocess.run(command, capture_output=True, text=True, env=os.environ | {"REFERENCE": str(WORK)})
    if done.returncode:
        raise RuntimeError((done.stdout + done.stderr).strip().splitlines()[-1])
    return done.stdout


def compiled() -> Iterator[str]:
    flags = f"-std=c++20 -O2 -ffp-contract=off -I{ROOT}/core"
    yield (
        f'c++ {flags} -I"$header" "{HERE}/c/cost.cpp" -L"$library" -lpunctura -o "{WORK}/cost" && '
        f'"{WORK}/cost" "{WORK}"'
    )
    yield (
        f'cd "{HERE}/rust" && export PUNCTURA_LIB_DIR=$library CARGO_TARGET_DIR="{WORK}/target" && need cargo cargo && '
        f'cargo run --offline --quiet --release --example cost "{WORK}"'
    )
    cs = HERE / "csharp"
    yield (
        f'need mcs mono-mcs; mcs -optimize -out:"{WORK}/Cost.exe" "{cs}"/*.cs "{cs}"/test/*.cs '
        f'-main:Test && mono "{WORK}/Cost.exe" "{WORK}" cost'
    )
    yield (
        f'need mkoctfile octave-dev; cd "{WORK}" && mkoctfile --mex -I"$header" -L"$library" -lpunctura '
        f'"{HERE}/octave/punctura_mex.c" -o punctura_mex.mex && FOLDER="{WORK}" octave-cli --no-history --norc '
        f'--path "{WORK}" --path "{HERE}/octave" "{HERE}/octave/cost.m"'
    )
    yield f'need wasm-ld lld; need node nodejs; bash "{HERE}/wasm/build.sh" >&2 && node "{HERE}/wasm/cost.mjs" "{WORK}"'


def best(ticks: int, rounds: int, go: Callable[[], object]) -> float:
    """The shortest processor time of a tick, ns."""
    times = []
    for _ in range(rounds):
        start = time.thread_time()
        go()
        times.append(time.thread_time() - start)
    return 1e9 * min(times) / ticks


def in_python(rows: np.ndarray, rate: float) -> Iterator[tuple[str, Callable[[], float]]]:
    scene = pn.load_scene(WORK / "scene.toml")
    p, a = np.ascontiguousarray(rows[:, :3]), np.ascontiguousarray(rows[:, 3:6])
    slow = rows[::10]  # the whole motion, ten times as fast
    few = len(slow)
    pairs = [(row[:3].tolist(), row[3:6].tolist()) for row in slow]
    insertion = pn.Insertion(scene)

    def steps() -> None:
        insertion.reset()
        for position, axis in pairs:
            insertion.step(position, axis)

    def poses() -> None:
        needle = PosedNeedle(scene)
        for k in range(0, 3200, 16):
            needle.move(k / rate, p[k], a[k])

    yield "Python: Insertion.run, all ticks in one call", lambda: best(len(p), 30, lambda: insertion.run(p, a))
    yield "Python: Insertion.step", lambda: best(few, 10, steps)
    yield "Python: PosedNeedle.move, a pose each 10 ms, cost of a pose", lambda: best(200, 10, poses)
    yield "MuJoCo: what attach() adds to mj_step()", mujoco_step
    yield "FMU in fmpy: set 6 inputs, step of one tick, get 3 outputs", lambda: fmu(slow, rate)
    yield "OpenIGTLink: answer, without the network, a transform a tick", lambda: openigtlink(slow, rate)


def mujoco_step() -> float:
    """What the needle adds to a step of MuJoCo. The needle of the robot is outside the tissue or at its surface."""
    import mujoco
    from punctura.mujoco import attach

    model = mujoco.MjModel.from_xml_path(str(HERE / "mujoco/robot.xml"))
    data = mujoco.MjData(model)
    alone = best(200, 10, lambda: [mujoco.mj_step(model, data) for _ in range(200)])
    attached = attach(model, pn.load_scene(WORK / "scene.toml"), needle="tip", tissue="phantom")
    return best(200, 10, lambda: [attached.step(data) for _ in range(200)]) - alone


def fmu(rows: np.ndarray, rate: float) -> float:
    sys.path.insert(0, str(HERE / "fmi"))
    from check import Slave  # type: ignore[import-not-found]

    slave = Slave(export_fmu(WORK / "scene.toml", WORK / "needle.fmu"))
    ticks = iter(range(10**9))

    def go() -> None:
        for row in rows:
            slave.step(next(ticks) / rate, 1 / rate, row[:6])

    return best(len(rows), 10, go)


def openigtlink(rows: np.ndarray, rate: float) -> float:
    sys.path.insert(0, str(HERE / "openigtlink"))
    from server import NeedleServer  # type: ignore[import-not-found]

    server, ticks = NeedleServer(str(WORK / "scene.toml"), [0.0, -1.0, 0.0], 20), iter(range(10**9))
    matrix = np.eye(4)

    def go() -> None:
        for row in rows:
            matrix[:3, 3] = row[:3] * 1e3
            server.answer(next(ticks) / rate, matrix)

    return best(len(rows), 20, go)


def measure() -> tuple[dict[str, float], set[str]]:
    """The shortest time of each way, ns, and what was left out."""
    found: dict[str, float] = {}
    missing: set[str] = set()

    def keep(name: str, ns: float) -> None:
        found[name] = min(ns, found.get(name, ns))

    rows = np.fromfile(WORK / "motion.f64", "<f8").reshape(-1, 9)
    rate = pn.load_scene(WORK / "scene.toml").servo.rate
    for _ in range(ROUNDS):
        for script in compiled():
            try:
                printed = run(script)
            except RuntimeError as error:
                missing.add(str(error))
                continue
            for name, ns in (line.split("\t") for line in printed.splitlines() if "\t" in line):
                keep(name, float(ns))
        for name, go in in_python(rows, rate):
            try:
                keep(name, go())
            except ImportError as error:
                missing.add(f"{name}: {error}")
    return found, missing


def processor() -> str:
    try:
        names = [line for line in Path("/proc/cpuinfo").read_text().splitlines() if line.startswith("model name")]
        return names[0].partition(":")[2].strip()
    except (OSError, IndexError):
        return "an unknown processor"


def table(found: dict[str, float]) -> str:
    rows = [f"| {name} | {ns / 1000:.{2 if ns < 1e4 else 0}f} |" for name, ns in found.items()]
    heading = f"Measured in one run of `integrations/cost.py` on {datetime.date.today():%Y-%m-%d}, {processor()}, "
    heading += (
        f"load {os.getloadavg()[0]:.0f}\non {os.cpu_count()} cores: the shortest of many runs in {ROUNDS} rounds.\n"
    )
    return heading + "\n| a tick from | microseconds |\n|---|---|\n" + "\n".join(rows) + "\n"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--write", action="store_true", help="write the table into docs/which-way-in.md")
    write = parser.parse_args().write
    subprocess.run([sys.executable, HERE / "reference.py", WORK], check=True)
    found, missing = measure()
    text = table(found)
    print(text)
    for line in sorted(missing):
        print(f"left out: {line}")
    if write:
        page = PAGE.read_text(encoding="utf-8")
        head, _, rest = page.partition(BEGIN)
        _, _, tail = rest.partition(END)
        PAGE.write_text(f"{head}{BEGIN}{text}{END}{tail}", encoding="utf-8")


if __name__ == "__main__":
    main()
