"""The evaluation of measured wake-ups in ./bench. Scripts replace the two measured programs."""

import json
import re
import sys

import numpy as np
import pytest
import run
import wakeups
from program import ProgramError
from ratios import over_cyclictest
from table import wakeup_table
from wakeups import measure_wakeups, quantile

from .test_bench_report import measured

LOOP = """
import array, json, sys
options = dict(zip(sys.argv[1::2], sys.argv[2::2]))
n = round(float(options["--seconds"]) * float(options["--rate"]))
array.array("q", [90000] * 320 + [6000] * (n - 320)).tofile(open(options["--dump"], "wb"))
granted = {granted}
print(json.dumps({{"ticks": n, "missed": 1, "realtime": {{"SCHED_FIFO real-time priority 80": granted}}}}))
"""
CYCLICTEST = """
import sys
options = dict(word.lstrip("-").partition("=")[::2] for word in sys.argv[1:])
assert options["interval"] == "625" and options["policy"] == {policy!r} and options.get("priority") == {priority!r}
n = int(options["loops"])
print("# /dev/cpu_dma_latency set to 0us\\nThread 0 Interval: 625")
for k in range(n):
    print(f"{{0:8d}}:{{k:8d}}:{{5000 if k >= 320 else 80000:8d}}")
"""


def script(path, text):
    """A Python program started by a shell script, because the path of this Python may contain a space."""
    code = path.with_suffix(".py")
    code.write_text(text)
    path.write_text(f'#!/bin/sh\nexec "{sys.executable}" -S -E "{code}" "$@"\n')
    path.chmod(0o755)
    return path


@pytest.fixture
def stand_ins(tmp_path, monkeypatch):
    """A loop with 6 us and a cyclictest with 5 us latency after the warm-up, both with or without a priority."""

    def make(granted=True, cyclictest=True):
        loop = script(tmp_path / "loop", LOOP.format(granted=granted))
        policy, priority = ("fifo", "80") if granted else ("other", None)
        other = script(tmp_path / "cyclictest", CYCLICTEST.format(policy=policy, priority=priority))
        monkeypatch.setattr(wakeups.shutil, "which", lambda name: str(other) if cyclictest else None)
        return loop

    return make


def test_both_are_measured_at_once_with_and_without_a_busy_core(stand_ins):
    result = measure_wakeups(stand_ins(), 10)
    assert [row["name"] for row in result["conditions"]] == ["nothing else", "one core busy"]
    for row in result["conditions"]:
        assert row["loop"] == {
            "p50_us": 6.0, "p99_us": 6.0, "p99_9_us": 6.0, "largest_us": 6.0, "wake_ups": 16000, "missed": 2,
        }  # fmt: skip
        assert (row["cyclictest"]["p99_9_us"], row["cyclictest"]["wake_ups"]) == (5.0, 16000)
        assert row["over_cyclictest"] == {"pooled": 1.2, "lower_quartile": 1.2, "upper_quartile": 1.2}
    assert all(r.passes and r.value == 1.2 for r in over_cyclictest(result))
    assert "   2 of 16000 skipped" in "\n".join(wakeup_table(result))


def test_without_a_granted_priority_both_run_without_it(stand_ins):
    result = measure_wakeups(stand_ins(granted=False), 0.5)
    assert result["priority"] == 0 and "no real-time priority" in next(wakeup_table(result))


def test_without_cyclictest_the_loop_is_measured_alone_and_no_check_passes(stand_ins, capsys):
    result = measured() | {"wakeups": measure_wakeups(stand_ins(cyclictest=False), 0.5)}
    assert run.report(result, run.all_ratios(result), None, check=True) == 1
    printed = capsys.readouterr().out
    assert "rt-tests" in printed and re.search(r"loop +6\.0", printed)
    assert "MISS  servo loop / cyclictest" in printed


def test_a_loop_that_wakes_too_late_fails_the_check(stand_ins, tmp_path, monkeypatch):
    result = measured() | {"wakeups": measure_wakeups(stand_ins(), 0.5)}
    assert run.report(result, run.all_ratios(result), tmp_path / "b.json", check=True) == 0
    written = json.loads((tmp_path / "b.json").read_text())
    assert written["wakeups"] == result["wakeups"] and written["ratios"][-1]["value"] == 1.2
    result["wakeups"]["conditions"][1]["over_cyclictest"]["pooled"] = 1.31
    assert run.report(result, run.all_ratios(result), None, check=True) == 1


def test_a_program_that_fails_ends_the_measurement(stand_ins, tmp_path):
    loop = stand_ins()
    script(tmp_path / "cyclictest", 'import sys; sys.exit("no rights")')
    with pytest.raises(ProgramError, match="no rights"):
        measure_wakeups(loop, 0.1)
    with pytest.raises(ProgramError, match="ended with 3"):
        measure_wakeups(script(tmp_path / "loop", "import sys; sys.exit(3)"), 0.1)


def test_unexpected_output_of_cyclictest_is_an_error(stand_ins, tmp_path):
    loop = stand_ins()
    script(tmp_path / "cyclictest", "print('T: 0 (1234) P:80 Min: 5')")
    with pytest.raises(ProgramError, match="reported 0 of 480 wake-ups; it began: T: 0"):
        measure_wakeups(loop, 0.1)


def test_a_quantile_is_a_latency_that_was_seen():
    latencies = np.array([2000, *[1000] * 1996, 9000, 9000, 9000])
    assert [quantile(latencies, share) for share in (0.5, 0.9985, 0.999)] == [1.0, 2.0, 9.0]
