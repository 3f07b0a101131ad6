"""A measured trace in the studio: a file is sent, looked at and identified, while the run goes on."""

import contextlib
import http.client
import json
import os
import sys
import urllib.parse

import numpy as np
import punctura as pn
import pytest
from punctura.live import SimulatedDevice
from punctura.record import RecordingError
from punctura.simulation import Strokes
from punctura.studio import computing, limits, security, traces
from punctura.studio.client import StudioClient
from punctura.studio.limits import MOST_TRACE
from punctura.studio.loaded import from_text
from punctura.studio.trace_lines import kept_samples
from punctura.studio.trace_worker import FieldError, do
from punctura.studio.traces import FILE, IDENTIFY, file_name
from punctura.studio.wire.identified import TraceJob
from punctura.trace import TraceError
from punctura.trace.columns import ColumnError
from recorded import recorded
from traces import trace
from waiting import PATIENCE_S, wait_until

NEEDLE = {"diameter_mm": "1.2", "tip_angle_deg": "22.918"}


def csv(header="time_s,depth_mm,force_N", **options):
    made = trace(noise=0.01, **options)
    rows = np.column_stack((made.time, made.depth * 1e3, made.force)).tolist()
    return "\n".join([header, *(",".join(f"{cell:.6g}" for cell in row) for row in rows)]).encode()


def send(served, path, body, /, name="a.csv", **asked):
    """Sends a file. Returns the open answer, and its connection."""
    connection = http.client.HTTPConnection("127.0.0.1", served.address.port, timeout=PATIENCE_S)
    query = urllib.parse.urlencode({"name": name, **asked}, doseq=True)
    connection.request("POST", f"{path}?{query}", body, {"Authorization": f"Bearer {served.address.token}"})
    return connection.getresponse(), connection


def lines(served, path, body, /, **asked):
    answer, connection = send(served, path, body, **asked)
    text = answer.read().decode()
    connection.close()
    assert answer.status == 200, text
    return [json.loads(line) for line in text.splitlines() if line]


def refused(served, path, body, /, **asked):
    answer, connection = send(served, path, body, **asked)
    text = answer.read().decode()
    connection.close()
    return answer.status, text


@pytest.mark.statistics
def test_a_trace_is_identified_while_the_run_goes_on_and_its_scene_can_be_felt(served, page):
    told = {line["kind"]: line for line in lines(served, IDENTIFY, csv(), membranes="1", **NEEDLE)}
    assert set(told) == {"step", "trace", "fit", "rivals", "report"}
    trace_line, fit = told["trace"], told["fit"]
    assert trace_line["name"] == "a.csv" and trace_line["samples"] == len(trace()) and len(trace_line["pops"]) == 1
    assert fit["rmse"] == pytest.approx(0.01, rel=0.1)
    assert {len(curve) for curve in fit["curves"].values()} == {trace_line["samples"]}
    [friction] = [one for one in fit["estimates"] if one["name"] == "membrane[0].friction"]
    assert friction["low"] < 0.2 < friction["high"] and friction["identifiable"]
    assert any("second time" in words for words in fit["verdicts"])
    rows = told["rivals"]["rows"]
    assert rows[0]["own"] and len(rows) >= 10
    assert {len(row["force"]) for row in rows} == {trace_line["samples"]}
    assert told["report"]["html"].startswith("<!doctype html>")
    # The scene goes the way of every other scene.
    assert from_text(fit["scene"]).scene.display.force_scale == "automatic"
    with StudioClient(served.address.url) as another:
        refusal = another.ask(do="load_text", toml=fit["scene"])
        assert not refusal["ok"] and "another page has control" in refusal["text"]
    assert page.ask(do="load_text", toml=fit["scene"])["ok"]
    page.wait(lambda: [m for m in page.of("scene") if m["scene"]["name"] == "a.csv"])
    assert served.session.pump.lost == 0


def test_what_a_file_does_not_state_is_asked_for_and_an_answer_is_enough(served):
    body = csv("a,b,load_kN")
    [told] = lines(served, FILE, body)
    assert [one["name"] for one in told["columns"]] == ["a", "b", "load_kN"]
    roles = {role["role"]: role for role in told["roles"]}
    assert (roles["depth"]["column"], roles["depth"]["needed"]) == ("", True)
    assert roles["force"]["column"] == "load_kN" and [one["unit"] for one in told["columns"]] == ["", "", "kN"]
    assert (roles["time"]["column"], roles["time"]["needed"]) == ("", False)
    [last] = lines(served, IDENTIFY, body, **NEEDLE)
    assert last["kind"] == "error" and last["field"] == "column.depth" and "'load_kN'" in last["text"]
    [last] = lines(served, IDENTIFY, body, column="depth=b", **NEEDLE)
    assert last["field"] == "unit.depth" and "not stated" in last["text"] and "--" not in last["text"]
    at_rest = csv("time_s,depth_mm,a")
    at_rest = b"\n".join(line + (b",force_N" if i == 0 else b",0.5") for i, line in enumerate(at_rest.split(b"\n")))
    first, *_, severe = lines(served, IDENTIFY, at_rest, **NEEDLE)
    assert first["kind"] == "trace" and severe["field"] == "column.force" and "the same" in severe["text"]


@pytest.mark.parametrize(
    "asked, field",
    [
        ({"diameter_mm": ""}, "diameter_mm"),
        ({"diameter_mm": "-1"}, "diameter_mm"),
        ({"tip_angle_deg": "95"}, "tip_angle_deg"),
        ({"membranes": "99"}, "membranes"),
        ({"order": "random"}, "order"),
    ],
)
def test_a_wrong_value_is_told_with_its_field(asked, field):
    with pytest.raises(FieldError) as told:
        do(TraceJob(task="identify", file="a.csv", **(NEEDLE | asked)), lambda line: None)
    assert told.value.field == field


@pytest.mark.parametrize(
    "asked, field",
    [({"units": {"depth": "furlong"}}, "unit.depth"), ({"columns": {"force": "nothing"}}, "column.force")],
)
def test_a_wrong_column_is_told_with_its_field(tmp_path, asked, field):
    (tmp_path / "a.csv").write_bytes(csv())
    with pytest.raises(ColumnError) as told:
        do(TraceJob(task="identify", file=str(tmp_path / "a.csv"), **NEEDLE, **asked), lambda line: None)
    assert told.value.field == field


@pytest.mark.parametrize(
    "name, body", [("a.xlsx", b"PK no"), ("a.mat", b"no"), ("a.parquet", b"PAR1no"), ("a.csv", b"")]
)
def test_a_file_that_is_no_trace_is_told_in_a_sentence(tmp_path, name, body):
    (tmp_path / name).write_bytes(body)
    with pytest.raises((TraceError, RecordingError), match=name):
        do(TraceJob(task="look", file=str(tmp_path / name)), lambda line: None)


def test_a_recording_states_its_columns_and_its_needle(tmp_path):
    scene = pn.load_scene("k06-fig12")
    strokes = Strokes((0, 5e-3, 0), (0, -0.02, 0), count=1)
    recorded(tmp_path / "run.parquet", SimulatedDevice(strokes, real_time=False, ticks=200), scene, 200)
    told = []
    do(TraceJob(task="look", file=str(tmp_path / "run.parquet")), told.append)
    assert told[0].roles == [] and told[0].needle.diameter == scene.needle.diameter


def test_a_file_that_is_too_large_is_refused(served, monkeypatch):
    connection = http.client.HTTPConnection("127.0.0.1", served.address.port, timeout=PATIENCE_S)
    head = {"Authorization": f"Bearer {served.address.token}", "Content-Length": str(MOST_TRACE + 1)}
    connection.request("POST", FILE, headers=head)
    assert connection.getresponse().status == 413
    monkeypatch.setattr(security, "MOST_TRACE", 1000)  # for a body of unknown length
    status, text = refused(served, FILE, iter([b"1,2\n" * 300]))
    assert status == 413 and "too large" in text
    monkeypatch.undo()
    [told] = lines(served, FILE, b"no numbers")  # the place is free again
    assert told["kind"] == "error" and told["field"] == "file"


def test_a_file_that_comes_too_slowly_frees_the_place(served, monkeypatch):
    monkeypatch.setattr(limits, "FILE_S", 0.2)
    connection = http.client.HTTPConnection("127.0.0.1", served.address.port, timeout=PATIENCE_S)
    head = {"Authorization": f"Bearer {served.address.token}", "Content-Length": "1000"}
    connection.request("POST", FILE, b"0,1\n", head)  # the rest never comes
    answer = connection.getresponse()
    assert answer.status == 408 and b"did not arrive within 0.2 s" in answer.read()
    monkeypatch.undo()
    wait_until(lambda: send(served, FILE, csv())[0].status == 200)


def test_a_file_is_sent_to_its_own_addresses_only_and_with_the_token(served):
    assert refused(served, "/api/schema", b"1")[0] == 405
    connection = http.client.HTTPConnection("127.0.0.1", served.address.port, timeout=PATIENCE_S)
    connection.request("POST", FILE, b"1")
    assert connection.getresponse().status == 401


def test_one_computation_runs_at_a_time_the_others_wait_and_one_that_is_left_ends(served, monkeypatch, tmp_path):
    mark = tmp_path / "pid"
    program = f"import os, pathlib, time; pathlib.Path({str(mark)!r}).write_text(str(os.getpid())); time.sleep(600)"
    monkeypatch.setattr(traces, "COMMAND", [sys.executable, "-c", program])
    answer, connection = send(served, IDENTIFY, csv(), **NEEDLE)
    assert answer.status == 200
    wait_until(mark.exists)
    monkeypatch.undo()
    waiting = [send(served, FILE, csv())[0] for _ in range(2)]
    told = [json.loads(next(line for line in one if line.strip())) for one in waiting]
    assert [one["words"] for one in told] == [f"waiting: {n} computation(s) before this one" for n in (1, 2)]
    monkeypatch.setattr(computing, "MOST_WAITING", 2)
    status, text = refused(served, FILE, csv())
    assert status == 422 and "2 computations wait already" in text
    connection.close()  # as the page's Cancel does
    for one in waiting:
        last = [json.loads(line) for line in one if line.strip()][-1]
        assert last["kind"] == "trace" and last["name"] == "a.csv"
    wait_until(lambda: not alive(int(mark.read_text())))


def test_one_that_waits_and_is_left_gives_its_turn_to_the_next():
    line, ran = computing.Line(), []

    def computation(name):
        return line.in_turn(lambda: iter([ran.append(name) or b"result"]), str.encode)

    first, second, third = (computation(name) for name in ("first", "second", "third"))
    assert next(first) == b"result"
    assert next(second).startswith(b"waiting: 1") and next(third).startswith(b"waiting: 2")
    second.close()
    first.close()
    assert list(third)[-1] == b"result" and ran == ["first", "third"]


def alive(process):
    with contextlib.suppress(OSError):
        os.kill(process, 0)
        return True
    return False


def test_a_file_is_never_run_as_code(served, tmp_path, monkeypatch):
    monkeypatch.setattr(traces, "file_name", lambda name: name)  # as if a name of a module were kept
    code = f"open({str(tmp_path / 'ran')!r}, 'w')"
    [told] = lines(served, FILE, code.encode(), name="numpy.py")
    assert told["kind"] == "error" and told["field"] == "file"
    assert not (tmp_path / "ran").exists()


def test_a_worker_that_ends_early_tells_why(served, monkeypatch):
    monkeypatch.setattr(traces, "COMMAND", [sys.executable, "-c", "raise TypeError('a wrong number')"])
    [told] = lines(served, FILE, csv())
    assert told["kind"] == "error" and "please report it" in told["text"]


@pytest.mark.parametrize(
    "name, kept",
    [
        ("a.csv", "a.csv"),
        ("../../etc/x.csv", "_.._etc_x.csv"),
        ("", "trace.txt"),
        ("nul.xlsx", "trace.xlsx"),
        ("numpy.py", "numpy.py.txt"),
        ("matplotlibrc", "matplotlibrc.txt"),
        ("a.CSV", "a.CSV"),
    ],
)
def test_a_file_gets_a_safe_name_that_keeps_its_ending(name, kept):
    assert file_name(name) == kept
    assert file_name("é" * 300 + ".mat").endswith(".mat")


def test_a_thinned_curve_keeps_its_peaks():
    curve = np.random.default_rng(1).normal(size=50_000)
    kept = kept_samples([curve, -2 * curve])
    assert len(kept) <= 3100 and kept[0] == 0 and kept[-1] == 49_999 and (np.diff(kept) > 0).all()
    assert curve[kept].max() == curve.max() and curve[kept].min() == curve.min()
