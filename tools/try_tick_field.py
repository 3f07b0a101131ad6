"""Adds a field to the core's table of a tick by one line, in a copy of the tree, and checks where it appears.

    python tools/try_tick_field.py [FOLDER]     default: build/try-field; takes some minutes, because it builds the copy

The new field must appear in Ticks, in a recording, in an export, in the page's frames and in docs/tick.md.
"""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
TABLE = "core/punctura/servo/tick_table.hpp"
LINE = """    detail::tick_field<TickPart::snapshot>("power", "power_W", "W", use_page,
        [](auto& s) { return s.force[0] * s.tip[0]; }, "A field that only this tool adds"),
"""

CHECK = """
import subprocess, sys, time
import numpy as np
import punctura as pn
from punctura.live import ServoLoop, SimulatedDevice
from punctura.record import Recorder, export, open_recording
from punctura.simulation import Strokes
from punctura.studio.wire import decode_ticks, encode_ticks

device = SimulatedDevice(Strokes((0, 5e-3, 0), (0, -0.02, 0)), real_time=False, ticks=800)
loop = ServoLoop(device, pn.load_scene("k06-fig10"))
listener, recorder = loop.listen(), Recorder(loop, "run.parquet")
loop.start()
while not device.finished:
    time.sleep(0.01)
loop.stop()
recorder.finish()
ticks = listener.read()
recording = open_recording("run.parquet")
export("run.parquet", "run.csv")
subprocess.run([sys.executable, "tools/make_tick_table.py"], check=True)
holds = {
    "Ticks": np.array_equal(ticks.power, ticks.force[:, 0] * ticks.tip[:, 0]),
    "to_pandas": "power_W" in ticks.to_pandas(),
    "recording": np.array_equal(recording.ticks().power, ticks.power) and "power_W" in recording.schema.names,
    "CSV export": "power_W" in open("run.csv").readline().split(","),
    "page's frame": np.array_equal(decode_ticks(encode_ticks(ticks, 0)).ticks.power, ticks.power.astype(np.float32)),
    "page's table": '"power_W"' in open("web/src/wire/tick_table.ts").read(),
    "docs/tick.md": "| `power` | (n,) | `power_W` | W |" in open("docs/tick.md").read(),
}
for where, there in holds.items():
    print(f"  {where:14} {'yes' if there else 'NO'}")
sys.exit(not all(holds.values()))
"""


def main() -> int:
    copy = Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "build" / "try-field").resolve()
    shutil.rmtree(copy, ignore_errors=True)
    subprocess.run(["git", "clone", "--quiet", str(ROOT), str(copy)], check=True)
    table = copy / TABLE
    text = table.read_text(encoding="utf-8")
    end = text.index("};\n// clang-format on")
    table.write_text(text[:end] + LINE + text[end:], encoding="utf-8")
    subprocess.run(["git", "-C", str(copy), "diff", "--stat"], check=True)
    subprocess.run([str(copy / "test"), "tree"], check=True, cwd=copy)
    return subprocess.run([str(copy / ".venv/bin/python"), "-c", CHECK], cwd=copy, check=False).returncode


if __name__ == "__main__":
    sys.exit(main())
