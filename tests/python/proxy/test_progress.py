"""Long runs: their progress, and Ctrl-C."""

import _thread
import sys
import threading

import numpy as np
import pytest
from punctura import Coupling, Insertion, Membrane, Needle, Proxy1d, Proxy3d, ThickLaw, load_scene, simulate
from punctura import progress as shown
from punctura.simulation import Experiment, Target

NEEDLE, MEMBRANE, COUPLING = Needle(1.08e-3, 0.28), Membrane(570, 0.41, 0.2, 1e-3), Coupling(400, 1)
SCENE, DOWN = load_scene("k06-fig12"), [0.0, -1.0, 0.0]
LONG = 200_000
DEPTHS = np.linspace(-1e-3, 9e-3, LONG)
PATH = np.outer(DEPTHS, DOWN)

RUNS = {
    "proxy on a line": lambda **more: Proxy1d(ThickLaw(NEEDLE, MEMBRANE), COUPLING, 1 / 1600).run(DEPTHS, **more),
    "proxy in space": lambda **more: Proxy3d(NEEDLE, MEMBRANE, [0, 0, 0], DOWN, COUPLING, 1 / 1600).run(
        PATH, DOWN, **more
    ),
    "insertion": lambda **more: Insertion(SCENE).run(PATH, DOWN, **more),
    "experiment": lambda **more: Experiment(SCENE, Target([0, 1e-3, 0])).run(LONG / SCENE.servo.rate, **more),
    "simulate": lambda **more: simulate(SCENE, PATH, **more),
}


@pytest.fixture(params=RUNS)
def run(request):
    return RUNS[request.param]


def test_a_function_gets_the_finished_share(run):
    shares = []
    assert len(run(progress=shares.append)) == LONG
    assert shares == sorted(shares) and 0 < shares[0] <= shares[-1] == 1.0


def test_an_error_of_the_function_ends_the_run(run):
    def fail(share):
        raise KeyError(share)

    with pytest.raises(KeyError):
        run(progress=fail)


def test_progress_is_a_function_or_true(run):
    assert len(run(progress=False)) == LONG
    with pytest.raises(TypeError, match="a function of the finished share, or True"):
        run(progress="yes")


class Terminal:
    def __init__(self):
        self.text = ""

    def isatty(self):
        return True

    def write(self, text):
        self.text += text
        return len(text)

    def flush(self):
        pass


def test_true_draws_a_bar_on_a_terminal_only(run, monkeypatch, capsys):
    monkeypatch.setattr(shown, "PATIENCE_S", 0.0)
    monkeypatch.setenv("TERM", "xterm")  # on a terminal that cannot move its cursor, there is no bar
    run(progress=True)
    assert capsys.readouterr().err == ""
    terminal = Terminal()
    monkeypatch.setattr(sys, "stderr", terminal)
    run(progress=True)
    assert "100%" in terminal.text


@pytest.mark.skipif(threading.current_thread() is not threading.main_thread(), reason="Ctrl-C is for the main thread")
def test_ctrl_c_ends_a_run_whose_object_stays_where_it_was_then():
    insertion = Insertion(SCENE)
    shares = []

    def interrupt(share):
        shares.append(share)
        _thread.interrupt_main()  # what Ctrl-C does

    with pytest.raises(KeyboardInterrupt):
        insertion.run(np.tile(PATH, (40, 1)), DOWN, progress=interrupt)
    assert 0 < shares[-1] < 1
    assert insertion.tip != [0, 0, 0]
    assert np.isfinite(insertion.step([0, 0, 0], DOWN)).all()
