"""Compares the clamp of K06 (33) with external solvers: Siconos' relay, SciPy's bounded least squares."""

import subprocess
from pathlib import Path

import numpy as np
import pytest
from oracles import cases, core, proxy_1d, random_runs, siconos_relay_path
from scipy.optimize import lsq_linear

SYSTEM_PYTHON = "/usr/bin/python3"  # Debian's python3-siconos is built for this one


@pytest.fixture(scope="module")
def relays():
    """Rows f*, lower, upper [N] of ticks that slide and ticks that stick, and the force that the core found in each."""
    r = random_runs.runs(21, max(25, cases.count(100)), 60)  # fewer have too few ticks that stick
    t = random_runs.ticks(r, *core.walk_1d(r, "paper"))
    hold = proxy_1d.f_star(t.coupling, t.before, t.p)
    q_star = t.p + (t.coupling.B * t.before.e + t.coupling.T * t.before.f) / t.coupling.D
    edges = np.array([core.law(r.parameters, lane).bounds(q) for lane, q in zip(t.lane, q_star.tolist(), strict=True)])

    thick = t.law.H > 0  # at a jump of the thin law rounding of q* decides which side's band is meant
    slides = thick & ((hold < edges[:, 0]) | (hold > edges[:, 1])) & (edges[:, 0] < edges[:, 1])
    sticks = thick & (hold >= edges[:, 0]) & (hold <= edges[:, 1])
    chosen = np.concatenate([np.flatnonzero(slides)[:2000], np.flatnonzero(sticks)[:1000]])
    assert min(slides.sum(), sticks.sum()) > 200
    return np.column_stack([hold, edges])[chosen], t.f[chosen]


def test_the_force_of_33_is_the_force_that_siconos_finds_for_the_same_relay(relays, tmp_path: Path):
    """Needs the Debian package python3-siconos. ./test installs it, and skips this test only if no archive has it."""
    rows, forces = relays
    np.save(tmp_path / "cases.npy", rows)
    command = [SYSTEM_PYTHON, siconos_relay_path, tmp_path / "cases.npy", tmp_path / "answers.npy"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, f"Siconos did not run (apt-get install python3-siconos):\n{done.stderr}"
    assert abs(np.load(tmp_path / "answers.npy") - forces).max() <= 1e-12


def test_the_force_of_33_is_the_force_in_the_band_that_is_nearest_to_the_holding_force(relays):
    """The relay's variational inequality is the condition of least squares: min (f - f*)^2 over the band."""
    for (hold, lower, upper), force in zip(*relays, strict=True):
        if lower < upper:
            nearest = lsq_linear([[1.0]], [hold], bounds=([lower], [upper]), method="bvls").x[0]
            assert abs(nearest - force) <= 1e-12
