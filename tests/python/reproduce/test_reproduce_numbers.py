"""Compares the numbers in the figures' CSV files with the law."""

import math
from collections.abc import Callable

import numpy as np
import pytest
from punctura import Insertion, Membrane, Needle, ThinLaw
from punctura.reproduce.experiment import (
    COUPLING,
    INWARD,
    NEEDLE,
    alternations,
    k06_membrane,
    k06_scene,
    of_law,
    operate,
)

pytestmark = pytest.mark.xdist_group("reproduction")  # in one worker: what they share takes seconds to make


F = 0.41024  # N, the dry friction of the shaft
COUNT_MM = 0.055  # of the encoder
Column = Callable[..., np.ndarray]


def run(column: Column, figure: str) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """p_y (mm), f_y (N) and stage of the experiment."""
    mine = column(figure, "line", str) == "experiment"
    return (
        column(figure, "p_y_mm")[mine], column(figure, "f_y_exact_N")[mine], column(figure, "stage", str)[mine]
    )  # fmt: skip


def pop_of(thickness: float) -> tuple[float, float]:
    """Depth of the hand (mm) and force (N) at the peak: the coupling is stretched by the force."""
    law = of_law(NEEDLE, k06_membrane(thickness))
    return (law.pop_depth + law.peak / COUPLING.stiffness) * 1e3, law.peak


@pytest.mark.parametrize("mu", [0.01, 0.1, 0.2])
def test_fig_3_draws_the_thin_law_with_its_jumps(column: Column, mu: float) -> None:
    law = ThinLaw(Needle(1e-3, math.pi / 12), Membrane(600.0, 0.4, mu, 0.0))
    q, lower = column("fig03", "q_mm"), column("fig03", f"phi_I_N (mu={mu:g})")
    np.testing.assert_array_equal(np.sort(q), q)
    assert lower.min() == pytest.approx(-law.A_I * (law.X + law.Q), rel=1e-12)
    assert lower[-1] == pytest.approx(-2 * mu * (600.0 * 1e-3 + 0.4), rel=1e-12)
    steps = np.abs(np.diff(lower)) > 0.05
    assert steps.sum() == 2 and np.diff(q)[steps].max() < 1e-12, "both jumps are upright"


def test_fig_5_ends_at_the_same_friction_for_every_thickness_and_pops_less_the_thicker(column: Column) -> None:
    peaks = []
    for h in (5, 3, 1, 0.5, 0.1):
        lower, upper = column("fig05", f"Phi_I_N (H={h:g} mm)"), column("fig05", f"Phi_O_N (H={h:g} mm)")
        assert (lower[-1], upper[-1]) == pytest.approx((-F, F), abs=1e-12)
        assert (lower <= upper).all()
        peaks.append(-lower.min())
    assert peaks == sorted(peaks)
    assert peaks[-1] == pytest.approx(0.7297894, abs=1e-6)


@pytest.mark.parametrize(("figure", "friction"), [("fig10", F), ("fig11", F), ("fig12", 2 * F)])
def test_the_shaft_is_held_by_the_same_friction_in_and_out(column: Column, figure: str, friction: float) -> None:
    p, f, stage = run(column, figure)
    deep = p < -10 if figure == "fig12" else p < -9
    assert np.median(f[deep & (stage == "insertion")]) == pytest.approx(friction, abs=1e-12)
    assert f.min() == pytest.approx(-friction, abs=1e-12)


def test_fig_10_pops_where_the_law_and_the_coupling_say(column: Column) -> None:
    p, f, _ = run(column, "fig10")
    depth, peak = pop_of(0.1e-3)
    assert f.max() == pytest.approx(peak, abs=2e-3)
    assert -p[np.argmax(f)] == pytest.approx(depth, abs=COUNT_MM)
    falls = np.flatnonzero(np.diff(f) < -0.3)
    assert len(falls) == 3, "three of the four strokes go through, each with a fall in one tick"
    np.testing.assert_allclose(f[falls], peak, atol=10e-3)
    np.testing.assert_allclose(f[falls + 1], F, atol=1e-12)


def test_fig_11_has_no_step_but_the_same_friction(column: Column) -> None:
    _, f, stage = run(column, "fig11")
    sliding = (stage[1:] == "insertion") & (stage[:-1] == "insertion")
    assert f.max() == pytest.approx(of_law(NEEDLE, k06_membrane(4e-3)).peak, abs=1e-4)
    assert np.diff(f)[sliding].min() > -0.02


def test_fig_12_pops_twice_where_the_law_and_the_coupling_say(column: Column) -> None:
    p, f, _ = run(column, "fig12")
    (first, first_peak), (second, second_peak) = pop_of(1e-3), pop_of(0.5e-3)
    second += 4.0  # 1 mm of membrane and a gap of 3 mm
    for depth in (first, second):
        near = np.abs(-p - depth) < 0.8
        assert -p[near][np.argmax(f[near])] == pytest.approx(depth, abs=2 * COUNT_MM)
    assert f.max() == pytest.approx(F + second_peak, abs=2e-3), "the second peak stands on the friction of the first"
    assert first_peak < f[np.abs(-p - first) < 0.1].max() < first_peak + second_peak


def test_every_experiment_follows_the_steady_pass_behind_it(column: Column) -> None:
    for figure in ("fig10", "fig11", "fig12"):
        p, f, stage = run(column, figure)
        steady = column(figure, "line", str) == "steady"
        x, y = column(figure, "p_y_mm")[steady], column(figure, "f_y_exact_N")[steady]
        half = x.size // 2
        inward = np.interp(p[stage == "insertion"], x[:half][::-1], y[:half][::-1])
        assert np.median(np.abs(f[stage == "insertion"] - inward)) < 3e-3


def test_the_papers_form_turns_at_nearly_every_tick_of_the_entry_and_the_exact_one_never(column: Column) -> None:
    assert alternations(column("chatter", "f_y_paper_N")) > 0.95 * 0.84 / 5 * 1600  # 0.84 mm at 5 mm/s
    assert alternations(column("chatter", "f_y_exact_N")) == 0
    paper, exact = column("chatter-thickness", "turns_paper"), column("chatter-thickness", "turns_exact")
    thin = column("chatter-thickness", "H_mm") < 0.21
    assert paper[thin].min() >= 5 and paper.max() > 250
    assert exact.max() <= 1 and paper[~thin].max() <= 1


def test_the_steady_run_gives_the_reference_numbers_of_the_pop(made) -> None:
    measured = {row.quantity: row.measured for row in made.measured if row.figure == "Close-up"}
    assert measured["force before the pop at 5 mm/s, exact"] == pytest.approx(0.7296, abs=2e-4)
    assert measured["force after the pop at 5 mm/s, exact"] == pytest.approx(F, abs=1e-12)


def test_every_measured_number_lies_near_the_expected_one(made) -> None:
    for row in made.measured:
        if row.expected == row.expected:
            assert row.measured == pytest.approx(row.expected, rel=0.01), row


def test_the_experiment_is_the_model_on_the_measured_positions_with_no_limit_acting() -> None:
    experiment = operate(k06_scene("k06-fig12"), 11.0)
    again = Insertion(experiment.scene).run(experiment.trace.position, INWARD)
    np.testing.assert_array_equal(again.force, experiment.trace.model_force)
    np.testing.assert_array_equal(experiment.trace.force, experiment.trace.model_force)
    trace = experiment.trace
    assert trace.peak_limited[-1] == trace.continuous_limited[-1] == trace.temperature_limited[-1] == 0


def test_the_pop_picture_lies_on_the_band_it_is_drawn_over(column: Column) -> None:
    depth, force, stage = column("pop", "depth_mm"), column("pop", "f_y_N"), column("pop", "stage", str)
    band = column("pop-band", "depth_mm")
    push = np.interp(depth, band, column("pop-band", "push_N"))
    pull = np.interp(depth, band, column("pop-band", "pull_N"))
    np.testing.assert_allclose(force[stage == "insertion"], push[stage == "insertion"], atol=2e-3)
    np.testing.assert_allclose(force[stage == "withdrawal"], pull[stage == "withdrawal"], atol=2e-3)
    assert ((force >= pull - 2e-3) & (force <= push + 2e-3)).all()
    assert set(stage) == {"outside", "insertion", "reversal", "withdrawal"}
