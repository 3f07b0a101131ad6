"""A study on a local Dask cluster whose workers go away midway: every row once, equal to the undisturbed run."""

import os
import signal
import socket
import sys
import tempfile
import threading
import time
from collections.abc import Callable
from pathlib import Path

import dask
import distributed
import pyarrow.parquet as pq
from punctura.study import Plan, StudyError, load_plan, run_study

PLAN = """
scene = "k06-fig12"
method = "monte_carlo"
samples = 2000
seed = 3
duration_s = 1.0
chunk = 50
results = ["peak", "drop[0]"]
[motion]
duration_s = 0.4
rest_s = 0.1
[[variable]]
path = "membrane[0].friction"
low = 0.1
high = 0.3
"""


def kill(cluster: distributed.LocalCluster, count: int) -> None:
    """Kills this many workers. The nanny of each starts it anew."""
    for nanny in list(cluster.workers.values())[:count]:
        os.kill(nanny.pid, signal.SIGKILL)


def replace_all(cluster: distributed.LocalCluster) -> None:
    """Other workers come after all have gone."""
    cluster.scale(0)
    while cluster.workers or cluster.scheduler.workers:
        time.sleep(0.05)
    cluster.scale(2)


def run_with_trouble(plan: Plan, out: Path, trouble: Callable[[distributed.LocalCluster], None]) -> bool:
    """Runs the study on two workers, with some trouble after three chunks. Returns whether the trouble came in time."""
    came: list[int] = []
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:

        def make() -> None:
            while (count := len(list(out.glob("chunk-*.parquet")))) < 3:
                time.sleep(0.005)
            came.append(count)
            trouble(cluster)

        threading.Thread(target=make, daemon=True).start()
        run_study(plan, out, scheduler=cluster.scheduler_address)
    return bool(came) and came[0] < 40


def refused(plan: Plan, out: Path, address: str, words: str) -> bool:
    try:
        run_study(plan, out, scheduler=address)
    except StudyError as bad:
        print(bad)
        return words in str(bad)
    return False


def main() -> int:
    dask.config.set({"distributed.deploy.lost-worker-timeout": "120s"})  # a busy computer starts a worker in 15 to 30 s
    troubles = {"one": lambda of: kill(of, 1), "both": lambda of: kill(of, 2), "replaced": replace_all}
    with tempfile.TemporaryDirectory() as name, socket.create_server(("127.0.0.1", 0)) as silent:
        folder = Path(name)
        (folder / "plan.toml").write_text(PLAN)
        plan = load_plan(folder / "plan.toml")
        run_study(plan, folder / "alone")
        alone = pq.read_table(folder / "alone" / "trials.parquet")
        for trouble, make in troubles.items():
            in_time = run_with_trouble(plan, folder / trouble, make)
            together = pq.read_table(folder / trouble / "trials.parquet")
            if not in_time or not together.equals(alone) or together["row"].to_pylist() != list(range(2000)):
                print(f"{trouble}: the table of the cluster differs, or no worker was gone in time")
                return 1
        port = silent.getsockname()[1]
        if not refused(plan, folder / "nobody", "tcp://127.0.0.1:1", "no Dask scheduler answers (Timed out"):
            return 1
        if not refused(plan, folder / "silent", f"tcp://127.0.0.1:{port}", "says nothing within 10 s"):
            return 1
    print("dask: with one worker killed, both killed, and both replaced, each of 2000 rows is there once, equal to a "
          "run on one computer")  # fmt: skip
    return 0


if __name__ == "__main__":
    sys.exit(main())
