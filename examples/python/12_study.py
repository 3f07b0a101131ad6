"""A study: what hand and friction do to the peak and the pop, in 60 trials with a simulated hand."""

from pathlib import Path
from tempfile import TemporaryDirectory

import pyarrow.parquet as pq
from punctura.study import load_plan, run_study

PLAN = """
scene = "k06-fig10"
method = "grid"
duration_s = 1.0
results = ["peak", "drop[0]"]

[motion]
count = 1
duration_s = 0.4
rest_s = 0.05

[[variable]]
path = "membrane[0].friction"
values = [0.1, 0.15, 0.2, 0.25, 0.3]

[[variable]]
path = "hand.stiffness"
values = [100.0, 150.0, 200.0, 250.0, 300.0, 350.0, 400.0, 450.0, 500.0, 550.0, 600.0, 650.0]
"""

with TemporaryDirectory() as name:
    folder = Path(name)
    (folder / "plan.toml").write_text(PLAN)
    run_study(load_plan(folder / "plan.toml"), folder / "study", progress=True)
    trials = pq.read_table(folder / "study" / "trials.parquet").to_pydict()

friction, stiffness, peaks = trials["membrane[0].friction"], trials["hand.stiffness"], trials["peak"]
for row in range(0, len(friction), 5):
    peak, drop = peaks[row], trials["drop[0]"][row]
    popped = "no pop" if drop is None else f"drop {drop:.3f} N"
    print(f"friction {friction[row]:.2f}   hand {stiffness[row]:3.0f} N/m   peak {peak:.3f} N   {popped}")
