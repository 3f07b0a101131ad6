"""A study on a local Dask cluster, of which a worker is killed midway: every row once, equal to the undisturbed run."""

from __future__ import annotations

import os
import signal
import sys
import tempfile
import threading
import time
from pathlib import Path

import distributed
import pyarrow.parquet as pq
from punctura.study import StudyError, load_plan, run_study

PLAN = """
scene = "k06-fig12"
method = "monte_carlo"
samples = 4000
seed = 3
duration_s = 1.0
chunk = 100
results = ["peak", "drop[0]"]
[motion]
duration_s = 0.4
rest_s = 0.1
[[variable]]
path = "membrane[0].friction"
low = 0.1
high = 0.3
"""


def main() -> int:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "plan.toml").write_text(PLAN)
        plan = load_plan(folder / "plan.toml")
        run_study(plan, folder / "alone")
        with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:
            killed: list[int] = []

            def kill_one() -> None:
                while len(list((folder / "cluster").glob("chunk-*.parquet"))) < 3:
                    time.sleep(0.005)
                killed.append(next(iter(cluster.workers.values())).pid)
                os.kill(killed[0], signal.SIGKILL)

            threading.Thread(target=kill_one, daemon=True).start()
            told: list[float] = []
            run_study(plan, folder / "cluster", progress=told.append, scheduler=cluster.scheduler_address)
        alone, together = (pq.read_table(folder / run / "trials.parquet") for run in ("alone", "cluster"))
        if not killed or not together.equals(alone) or together["row"].to_pylist() != list(range(4000)):
            print("the table of the cluster differs, or no worker was killed")
            return 1
        try:
            run_study(plan, folder / "nobody", scheduler="tcp://127.0.0.1:1")
        except StudyError as bad:
            print(bad)
        else:
            return 1
    print("dask: a worker was killed, and each of 4000 rows is there once, equal to a run on one computer")
    return 0


if __name__ == "__main__":
    sys.exit(main())
