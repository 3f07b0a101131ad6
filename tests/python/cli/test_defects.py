"""A defect is told from a mistake, and its traceback is kept where only its user can read it."""

import os
import stat
import subprocess
import sys

import numpy as np
import pyarrow as pa
import pytest
from punctura import load_scene
from punctura.cli import _app
from punctura.cli._status import DEFECT
from punctura.defects import explain, is_defect, log_file
from punctura.live import DeviceError
from punctura.studio.names import safe_name
from punctura.studio.pump import Defects
from punctura.ticks.files import save
from waiting import PATIENCE_S, wait_until

OURS = {"__package__": "punctura.record", "np": np}  # the globals of a module of Punctura
exec("def refuses(): raise ValueError('must be positive')", OURS)
exec("def adds(): return np.zeros(3) + np.zeros(4)", OURS)


@pytest.fixture(autouse=True)
def log(tmp_path, monkeypatch):
    """The log of this test; earlier tests have logged nothing."""
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    monkeypatch.setattr("punctura.defects._logged", {})
    return log_file()


def raised(act):
    try:
        act()
    except Exception as error:
        return error
    raise AssertionError("nothing was raised")


def text_of(log):
    """Another thread writes it."""
    return wait_until(lambda: log.exists() and log.read_text())


def unplugged():
    raise DeviceError("unplugged")


@pytest.mark.parametrize(
    "act",
    [
        lambda: load_scene("no such scene"),
        lambda: safe_name("a/b"),
        lambda: save(pa.table({}), "x.txt"),
        lambda: os.listdir("/no/such/folder"),
        lambda: np.zeros(1 << 50),
        unplugged,
        OURS["refuses"],
    ],
)
def test_what_punctura_or_the_system_refuses_is_no_defect(act):
    assert not is_defect(raised(act))


@pytest.mark.parametrize(
    "act",
    [
        OURS["adds"],
        lambda: int("x"),
        lambda: pa.array(["x"]).cast(pa.int8()),
        lambda: safe_name(None),
        lambda: {}["key"],
        lambda: np.reshape(np.zeros(3), (2, 2)),
    ],
)
def test_an_error_that_nobody_foresaw_is_a_defect_also_a_value_error(act):
    assert is_defect(raised(act))


def test_a_command_with_a_defect_names_the_log_with_its_traceback(punctura, monkeypatch, log):
    monkeypatch.setattr(_app, "build_app", lambda *_: lambda *_, **__: OURS["adds"]())
    done = punctura("scenes")
    assert done.status == DEFECT and "could not be broadcast" in done.stderr and str(log) in done.stderr
    assert "Traceback" not in done.stderr and done.stderr.count("\n") == 1
    assert "in adds\n" in text_of(log)
    assert [stat.S_IMODE(path.stat().st_mode) for path in (log, log.parent)] == [0o600, 0o700]


def test_where_the_log_cannot_be_written_the_traceback_is_on_the_terminal(punctura, monkeypatch):
    monkeypatch.setenv("XDG_STATE_HOME", os.devnull)
    monkeypatch.setattr(_app, "build_app", lambda *_: lambda *_, **__: OURS["adds"]())
    done = punctura("scenes")
    assert done.status == DEFECT and "the log cannot be written" in done.stderr and "in adds\n" in done.stderr


def test_a_traceback_is_on_the_terminal_on_request_also_that_of_a_mistake(punctura, monkeypatch, log):
    monkeypatch.setenv("PUNCTURA_DEBUG", "1")
    done = punctura("replay", "no such recording.parquet")
    assert "Traceback" in done.stderr and "RecordingError" in done.stderr and not log.exists()


@pytest.mark.skipif(os.name != "posix", reason="uses a pipe with a name")
def test_a_log_that_takes_for_ever_holds_nobody_up(log):
    log.parent.mkdir(parents=True)
    os.mkfifo(log)
    assert "a defect" in explain(raised(OURS["adds"]))  # the studio's worker calls this, and must go on
    log.read_text()  # the writer's open() returns; from Python 3.13 on a rotating log asks a pipe in vain where it is


def test_a_defect_in_every_turn_of_a_loop_is_logged_once_and_a_full_log_makes_room(log):
    log.parent.mkdir(parents=True)
    log.write_text("x" * 1_000_000)
    for _ in range(100):
        explain(raised(OURS["adds"]))
    wait_until(lambda: (log.parent / "defects.log.1").exists())
    assert text_of(log).count("in adds\n") == 1
    assert len(list(log.parent.iterdir())) == 2


def test_the_studio_tells_a_defect_once_and_does_not_call_a_lost_device_one(log):
    notices = []
    guard = Defects(type("Out", (), {"send": lambda _, notice: notices.append(notice.text)})()).guard
    for _ in range(3):
        guard(OURS["adds"])
    guard(unplugged)
    assert len(notices) == 2 and str(log) in notices[0] and notices[1] == "unplugged" and "in adds\n" in text_of(log)


@pytest.mark.parametrize("worker", ["punctura.compare.worker", "punctura.studio.trace_worker"])
def test_a_process_that_computes_for_the_studio_logs_its_defects(worker, log):
    program = f"import {worker} as w; w.do = lambda *_: [][1]; w.main()"
    job = '{"task": "look", "file": "x.csv"}'
    done = subprocess.run(
        [sys.executable, "-c", program],
        input=job,
        capture_output=True,
        text=True,
        timeout=PATIENCE_S,
        start_new_session=True,
    )
    assert done.returncode == 0 and "defect, please report it: IndexError" in done.stdout
    assert "IndexError" in log.read_text()
