"""The runner of the steps of ./test, with steps of its own."""

import os
import re
import select
import shlex
import signal
import subprocess
from pathlib import Path

import pytest
from waiting import PATIENCE_S, wait_until

TOOLS = Path(__file__).parents[2] / "tools"
pytestmark = pytest.mark.skipif(os.name != "posix", reason="./test is a program for bash")


ENDS = [signal.SIGINT, signal.SIGTERM, signal.SIGHUP] if os.name == "posix" else []


def _heeds_signals():
    for one in ENDS:
        signal.signal(one, signal.SIG_DFL)  # bash cannot catch what nohup or a background job ignores


def start(folder, steps, *asked, pass_fds=()):
    """Runs tools/steps.sh in the folder with these functions in place of its steps."""
    (folder / "build" / "log").mkdir(parents=True)
    script = f"""set -euo pipefail
root={shlex.quote(str(folder))}
source {shlex.quote(str(TOOLS / "say.sh"))}
source {shlex.quote(str(TOOLS / "steps.sh"))}
{steps}
choose_steps {" ".join(asked)}
run_steps
"""
    return subprocess.Popen(
        ["bash", "-c", script],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        start_new_session=True,
        pass_fds=pass_fds,
        preexec_fn=_heeds_signals,
    )


def test_each_step_is_told_in_its_order_and_a_failure_with_the_end_of_its_log(tmp_path):
    steps = "step_tree() { sleep 0.3; }; step_web() { echo said; return 3; }; step_cpp() { echo '2 passed in 1.0s'; }"
    with start(tmp_path, steps, "tree", "web", "cpp", "web") as run:
        printed = run.communicate(timeout=PATIENCE_S)[0]
    assert run.returncode == 1
    assert re.findall(r"^  (\w+) +(passed|FAILED)", printed, re.M) == [
        ("tree", "passed"), ("web", "FAILED"), ("cpp", "passed"),
    ]  # fmt: skip
    assert "    said\n" in printed and "2 passed in 1.0s" in printed and printed.endswith("2 passed, 1 failed\n")


def test_what_compiles_runs_beside_what_waits_and_the_steps_of_a_row_run_one_after_another(tmp_path):
    meet = "touch $1; for _ in $(seq 600); do if [ -e $2 ]; then return 0; fi; sleep 0.1; done; return 1"
    steps = (
        f"meet() {{ {meet}; }}; step_cpp() {{ meet a b && touch cpp_ended; }};"
        "step_python() { meet b a; }; step_asan() { test -e cpp_ended; }"
    )
    with start(tmp_path, steps, "cpp", "asan", "python") as run:
        printed = run.communicate(timeout=PATIENCE_S)[0]
    assert run.returncode == 0 and "3 passed, 0 failed" in printed


def test_a_step_that_was_killed_has_failed(tmp_path):
    with start(tmp_path, "step_web() { kill -KILL 0; }", "web") as run:
        printed = run.communicate(timeout=PATIENCE_S)[0]
    assert run.returncode == 1 and "FAILED" in printed and "0 passed, 1 failed" in printed


@pytest.mark.parametrize("how", ENDS)
def test_a_signal_ends_the_steps_in_the_background_although_one_of_them_has_finished(tmp_path, how):
    steps = "step_tree() { true; }; step_types() { touch begun; sleep 600; }; step_web() { sleep 600; }"
    alive, held = os.pipe()  # each process of the steps holds it
    with start(tmp_path, steps, "tree", "types", "web", pass_fds=[held]) as run:
        os.close(held)
        wait_until((tmp_path / "begun").exists, 60)
        assert run.stdout is not None and run.stdout.readline().startswith("  tree         passed")
        os.kill(run.pid, how)
        try:
            assert run.communicate(timeout=PATIENCE_S)[0].endswith("Stopped.\n")
        finally:
            run.kill()
        assert run.returncode == 130
    ended, _, _ = select.select([alive], [], [], 60)
    assert ended and os.read(alive, 1) == b""  # the end of the pipe: all of them have ended
    os.close(alive)
