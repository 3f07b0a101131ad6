"""`punctura rivals` before its fits: the needle of a recording, and outputs that cannot be written."""

import numpy as np
import punctura as pn
import pytest
from punctura._core import SimulatedDevice
from punctura.simulation import Strokes
from punctura.trace import read_trace
from recorded import recorded


@pytest.fixture
def needles(monkeypatch):
    """The needles with which fits would begin."""
    found = []

    def begins(trace, names, *, needle, **more):
        found.append(needle)
        raise pn.PuncturaError("the fits would begin now")

    monkeypatch.setattr("punctura.rivals.compare_trace", begins)
    return found


def push(folder):
    scene = pn.load_scene("k06-fig12").replace(needle=pn.Needle(1.7e-3, 0.31))
    strokes = Strokes((0, 2e-3, 0), (0, -9e-3, 0), 1, duration=1, rest=0.1)
    recorded(folder / "run.parquet", SimulatedDevice(strokes, real_time=False, ticks=3500), scene, 3500)
    return folder / "run.parquet"


def text(folder):
    depth = np.linspace(0, 8, 200)
    rows = np.column_stack([depth, 0.1 * depth])
    np.savetxt(folder / "a.csv", rows, delimiter=",", header="depth_mm,force_N", comments="")
    return folder / "a.csv"


def test_the_needle_of_a_recording_is_taken_unless_another_one_is_stated(punctura, needles, tmp_path):
    run, other = push(tmp_path), text(tmp_path)
    for arguments in ([run], [run, "--needle", "diameter_mm=1,tip_angle_rad=0.5"], [other]):
        assert "the fits would begin now" in punctura("rivals", *arguments).stderr
    assert needles == [pn.Needle(1.7e-3, 0.31), pn.Needle(1e-3, 0.5), None]


@pytest.mark.parametrize(
    ("option", "place", "words"),
    [
        ("--plot", "missing/plot.png", "there is no folder"),
        ("--plot", "folder.png", "is a folder"),
        ("--plot", "a.csv/plot.png", "there is no folder"),
        ("--out", "a.csv", "is a file, not a folder"),
        ("--out", "a.csv/fits", "is a file, not a folder"),
    ],
)
def test_an_output_that_cannot_be_written_is_told_before_the_fits(punctura, needles, tmp_path, option, place, words):
    (tmp_path / "folder.png").mkdir()
    done = punctura("rivals", text(tmp_path), option, tmp_path / place)
    assert done.status == 2 and words in " ".join(done.stderr.replace("│", " ").split()) and needles == []


def test_a_trace_without_a_pop_is_told_so_once(tmp_path):
    found = [str(one) for one in read_trace(text(tmp_path)).findings if one.kind == "no_pop"]
    advice = "if the tip is not through the wall yet, go deeper"
    assert found == [f"no pop: the force never drops while the needle goes in; {advice}"]
