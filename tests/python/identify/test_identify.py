"""Identification of synthetic traces: the truth lies inside the intervals, and what is not told is named."""

import errno
import json
import os
import threading
import warnings
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import punctura as pn
import pytest
import scipy.linalg  # noqa: F401  # its libraries are among those of threadpool_info
import threadpoolctl
from punctura.errors import IncompleteCallError
from punctura.identify import identify
from punctura.identify import scene as identified_scene
from punctura.identify.fit import Misfit, fit
from punctura.identify.model import OWN
from punctura.identify.moves import with_pops_moved
from punctura.identify.noise import effective_samples
from punctura.identify.parameters import Free, Parameters, default_coupling, default_membrane
from punctura.identify.scene import scene_of
from punctura.identify.walls import rise_starts
from punctura.one_thread import one_thread
from punctura.trace import Finding, Trace, TraceError, read_trace, segment
from punctura.trace.information import held_out
from traces import MEMBRANE, NEEDLE, force_of, motion, trace
from typer.testing import CliRunner
from waiting import PATIENCE_S

TRUTH = {
    "membrane[0].surface": 5e-3,
    "membrane[0].stiffness": MEMBRANE.stiffness,
    "membrane[0].precompression": MEMBRANE.precompression,
    "membrane[0].friction": MEMBRANE.friction,
    "coupling_stiffness": 4000,
}


def test_the_truth_of_a_synthetic_trace_is_found():
    found = identify(trace(noise=0.01), NEEDLE)
    assert found.extensions == () and len(found.parameters.membranes) == 1
    assert found.fit.rmse == pytest.approx(0.01, rel=0.05)
    estimates = {estimate.name: estimate for estimate in found.estimates}
    for name, value in TRUTH.items():
        estimate = estimates[name]
        assert estimate.identifiable
        width = estimate.high - estimate.low
        assert estimate.low - width / 2 < value < estimate.high + width / 2, name
    assert any("second time" in text for text in found.verdicts)


def test_without_a_withdrawal_the_verdict_asks_for_one():
    made = trace(noise=0.01)
    found = identify(made[: int(np.argmax(made.depth))], NEEDLE, membranes=1)
    assert any("withdrawal" in text for text in found.verdicts)


def test_a_trace_that_ends_before_the_pop_gives_the_surface_a_bound_near_the_trace_or_none():
    made = trace(noise=0.01)
    cut = made[: int(np.argmax(made.depth > 6e-3))]
    surface = identify(cut, NEEDLE, membranes=1).estimates[0]
    assert all(bound is None or abs(bound - 5e-3) < 2e-3 for bound in (surface.low, surface.high))


def test_coordinates_lead_back_to_the_parameters_and_keep_the_pop():
    row = default_membrane()
    row[:5] = [5.013e-3, 400, 0.2, 0.3, 0.3e-3]
    start = Parameters(NEEDLE, np.array([row]), default_coupling(900))
    free = Free(["membrane[0].surface", "tissue.stiffness", "tissue.thickness", "coupling_stiffness", "offset"], start)
    u = free.coordinates(start)
    np.testing.assert_allclose(free.parameters(u).vector(), start.vector(), rtol=1e-10)
    stiffer = u + np.array([0, 0.2, 0.1, -0.3, 0])
    changed = free.parameters(stiffer)
    assert changed.get("membrane[0].surface") != pytest.approx(5.013e-3, rel=1e-3)
    assert free.coordinates(changed)[0] == pytest.approx(u[0])


def test_a_parameter_at_its_bound_does_not_pass_it_by_a_rounding_error():
    start = Parameters(NEEDLE, np.array([default_membrane()]), default_coupling(900))
    free = Free(["relaxation_2_time"], start)
    assert np.exp(free.high[0]) > 1e4  # a scene takes at most 1e4 s
    assert free.parameters(free.high).get("relaxation_2_time") == 1e4


def test_the_coordinate_of_a_wall_that_pops_behind_the_trace_is_its_surface():
    row = default_membrane()
    row[:5] = [5.013e-3, 400, 0.2, 0.3, 0.3e-3]
    start = Parameters(NEEDLE, np.array([row]), default_coupling(900))
    free = Free(["membrane[0].surface", "tissue.stiffness"], start, deepest=6e-3)
    assert free.coordinates(start)[0] == pytest.approx(5.013e-3)


def test_coordinates_that_give_no_law_are_infinitely_far_from_the_trace():
    start = Parameters(NEEDLE, np.array([default_membrane()]), default_coupling(900))
    free = Free(["membrane[0].surface"], start)
    assert np.isinf(Misfit(trace(noise=0.01), start).residuals(free, np.array([np.nan]))).all()


@pytest.mark.parametrize("deepest", [np.inf, 6e-3])  # the wall pops deeper than 6 mm
def test_derivatives_by_coordinates_are_exact(deepest):
    made = trace(noise=0.01, surface=5.013e-3)
    row = default_membrane()
    row[:5] = [5.113e-3, 400, 0.2, 0.3, 0.3e-3]
    start = Parameters(NEEDLE, np.array([row]), default_coupling(900))
    names = ["membrane[0].surface", "tissue.stiffness", "tissue.friction", "coupling_stiffness", "drift"]
    free = Free(names, start, deepest)
    assert bool(free.walls) == np.isinf(deepest)
    misfit, u = Misfit(made, start), free.coordinates(start)
    jacobian = misfit.jacobian(free, u)
    for i in range(len(u)):
        step = np.zeros(len(u))
        step[i] = 1e-7 * max(abs(u[i]), 1e-2)
        difference = (misfit.residuals(free, u + step) - misfit.residuals(free, u - step)) / (2 * step[i])
        error = np.abs(difference - jacobian[:, i]) / np.abs(difference).max()
        assert np.quantile(error, 0.99) < 1e-5, free.names[i]


def test_correlated_noise_counts_as_fewer_samples():
    white = np.random.default_rng(4).normal(size=20000)
    slow = np.empty_like(white)
    slow[0] = white[0]
    for i in range(1, len(white)):
        slow[i] = 0.8 * slow[i - 1] + white[i]
    assert effective_samples(white) == pytest.approx(20000, rel=0.1)
    assert effective_samples(slow) == pytest.approx(20000 * 0.2 / 1.8, rel=0.2)


def test_a_severe_finding_stops_the_identification():
    made = trace()
    bad = Trace(
        made.depth, made.force, made.time, "a.csv", (Finding("wrong_unit", "1000 times too large", severe=True),)
    )
    with pytest.raises(TraceError, match=r"a.csv: wrong unit: 1000 times"):
        identify(bad, NEEDLE)


@pytest.mark.filterwarnings("error")
def test_a_depth_whose_unit_changes_in_the_file_is_named_as_the_reason_why_nothing_can_be_fitted(tmp_path):
    made = trace(noise=0.01)
    depth = np.where(np.arange(len(made)) < len(made) // 2, 1e3, 1) * made.depth  # in mm, then in m
    table = np.column_stack((made.time, depth, made.force))
    np.savetxt(tmp_path / "a.csv", table, delimiter=",", header="time_s,depth_mm,force_N", comments="")
    with pytest.raises(TraceError, match=r"a.csv: the needle goes in within \d samples.*axis is doubtful"):
        identify(read_trace(tmp_path / "a.csv"), NEEDLE, membranes=1)


def test_a_scene_of_unusual_values_gives_no_warning_about_units(recwarn):
    row = default_membrane()
    row[:5] = [5e-3, 0.11, 1.3, 0.2, 0.5e-3]
    scene = scene_of(Parameters(NEEDLE, np.array([row]), default_coupling(2.8)), "soft")
    assert scene.coupling.stiffness == 2.8 and not recwarn.list


def test_scenes_that_two_threads_make_at_once_leave_the_warnings_of_the_process_alone(monkeypatch):
    row = default_membrane()
    row[:5] = [5e-3, 0.11, 1.3, 0.2, 0.5e-3]
    parameters, began = Parameters(NEEDLE, np.array([row]), default_coupling(2.8)), threading.Barrier(3)
    first_done = threading.Event()
    whole = identified_scene._scene

    def slowly(given, name, as_table):
        began.wait(PATIENCE_S)
        began.wait(PATIENCE_S)
        if name == "second":
            first_done.wait(PATIENCE_S)
        return whole(given, name, as_table)

    monkeypatch.setattr(identified_scene, "_scene", slowly)
    before = list(warnings.filters)
    with ThreadPoolExecutor(2) as pool:
        made = [pool.submit(scene_of, parameters, name) for name in ("first", "second")]
        began.wait(PATIENCE_S)
        with pytest.warns(UserWarning, match="unusual"):  # meanwhile, in this thread
            pn.Needle(diameter=1.2, tip_angle=0.4)
        began.wait(PATIENCE_S)
        assert made[0].result(60).name == "first"
        first_done.set()
        assert made[1].result(60).name == "second"
    assert list(warnings.filters) == before
    with pytest.warns(UserWarning, match="unusual"):
        pn.Needle(diameter=1.2, tip_angle=0.4)


def test_the_command_writes_json_and_a_scene_that_runs(tmp_path):
    from punctura.cli._app import build_app

    made = trace(noise=0.01)
    table = np.column_stack((made.time, made.depth * 1e3, made.force))
    np.savetxt(tmp_path / "a.csv", table, delimiter=",", header="time_s,depth_mm,force_N", comments="")
    scene = str(tmp_path / "scene.toml")
    arguments = ["identify", str(tmp_path / "a.csv"), "--needle", "diameter_mm=1.2,tip_angle_rad=0.4", "--scene", scene]
    ran = CliRunner().invoke(build_app(), [*arguments, "--membranes", "1", "--json"])
    assert ran.exit_code == 0, ran.output
    record = json.loads(ran.stdout)
    assert record["rmse_N"] == pytest.approx(0.01, rel=0.05)
    assert {parameter["name"] for parameter in record["parameters"]} >= set(TRUTH)
    _, depth = motion()
    ticks = pn.simulate(scene, depth - 5e-3)
    assert np.abs(ticks.force).max() == pytest.approx(made.force.max(), rel=0.1)
    no_needle = CliRunner().invoke(build_app(), ["identify", str(tmp_path / "a.csv")])
    assert isinstance(no_needle.exception, IncompleteCallError) and "--needle" in str(no_needle.exception)
    blunt = ["identify", str(tmp_path / "a.csv"), "--needle", "diameter_mm=1.2,tip_angle_deg=160"]
    assert "tip_angle_deg = 160: must be between 0 and 90" in CliRunner().invoke(build_app(), blunt).output
    no_file = CliRunner().invoke(build_app(), ["identify", str(tmp_path / "b.csv")])
    assert no_file.exit_code == 2 and "b.csv" in no_file.output and "--needle" not in no_file.output


def test_a_place_that_cannot_be_written_is_named_before_the_computation_and_the_result_is_told_before_it(
    tmp_path, monkeypatch
):
    from punctura.cli import identify as command
    from punctura.cli._app import build_app

    made = trace(noise=0.01, hold=0.2, speed=10e-3)
    table = np.column_stack((made.time, made.depth * 1e3, made.force))
    np.savetxt(tmp_path / "a.csv", table, delimiter=",", header="time_s,depth_mm,force_N", comments="")
    given = ["identify", str(tmp_path / "a.csv"), "--needle", "diameter_mm=1.2,tip_angle_rad=0.4", "--membranes", "1"]
    wrong = {
        str(tmp_path): "is a folder; name a file",
        str(tmp_path / "none" / "a"): f"there is no folder {tmp_path / 'none'}; make it first",
    }
    for option in ("--scene", "--report", "--plan"):
        for place, reason in wrong.items():
            ran = CliRunner().invoke(build_app(), [*given, option, place], env={"COLUMNS": "400"})
            assert ran.exit_code == 2 and option in ran.output and reason in ran.output
            assert "punctura: K06" not in ran.output
    before, link, same = (tmp_path / "a.csv").read_bytes(), tmp_path / "link", str(tmp_path / "same")
    link.symlink_to(tmp_path / "a.csv")
    for place in (tmp_path / "a.csv", tmp_path / ".." / tmp_path.name / "a.csv", link):
        ran = CliRunner().invoke(build_app(), [*given, "--scene", str(place)], env={"COLUMNS": "400"})
        assert ran.exit_code == 2 and "is the file of TRACE, too; name another one" in ran.output
        assert (tmp_path / "a.csv").read_bytes() == before
    ran = CliRunner().invoke(build_app(), [*given, "--scene", same, "--plan", same], env={"COLUMNS": "400"})
    assert ran.exit_code == 2 and "is the file of --scene, too" in ran.output
    (tmp_path / "many").mkdir()
    (tmp_path / "many" / "broken.csv").write_text("time_s,depth_mm,force_N\n")
    ran = CliRunner().invoke(build_app(), ["identify", str(tmp_path / "many"), *given[2:], "--out", same])
    assert ran.exit_code == 1 and "0 of 1 traces identified" in ran.output and "broken.csv: " in ran.output
    ran = CliRunner().invoke(build_app(), ["identify", str(tmp_path), *given[2:], "--out", str(tmp_path / "a.csv")])
    assert ran.exit_code == 2 and "is a file, not a folder; name another folder" in ran.output

    def full(path, data):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), str(path))

    monkeypatch.setattr(command, "write_whole", full)
    ran = CliRunner().invoke(build_app(), [*given, "--scene", str(tmp_path / "scene.toml"), "--json"])
    assert ran.exit_code != 0 and json.loads(ran.stdout)["membranes"] == 1


def two_walls(noise=0.005, second=MEMBRANE):
    depth = np.linspace(0, 30e-3, 600)
    force = force_of(depth, 4e-3) + force_of(depth, 16e-3, second)
    return Trace(depth, force + noise * np.random.default_rng(2).normal(size=600))


def test_several_pops_give_starts_near_each_wall():
    made = two_walls()
    segments = segment(made)
    assert len(segments.pops) == 2
    for curved in (False, True):
        best = next(rise_starts(made, segments, NEEDLE, 2, curved))
        found = fit(Misfit(made, best), [f"membrane[{i}].{kind}" for i in range(2) for kind in OWN], best)
        moved = with_pops_moved(found)
        assert moved.sse <= found.sse
        assert moved.rmse < 0.05 * made.force.max()
        assert moved.parameters.membranes[:, 0] == pytest.approx([4e-3, 16e-3], abs=1e-3)


def test_one_tissue_is_chosen_where_the_walls_are_alike_and_not_where_they_differ():
    alike = identify(two_walls(), NEEDLE)
    assert alike.extensions == ("one tissue",) and len(alike.parameters.membranes) == 2
    assert alike.parameters.get("membrane[0].friction") == alike.parameters.get("membrane[1].friction")
    other = pn.Membrane(stiffness=300, precompression=0.2, friction=0.35, thickness=1.5e-3)
    differ = identify(two_walls(second=other), NEEDLE)
    assert "one tissue" not in differ.extensions


def test_held_out_samples_are_never_those_of_a_pop():
    made = two_walls()
    segments = segment(made)
    masks = held_out(len(made), segments)
    assert len(masks) == 4 and not np.any(np.sum(masks, axis=0) > 1)
    for pop in segments.pops:
        assert not any(mask[pop.start - 3 : pop.end + 4].any() for mask in masks)
    assert np.sum(masks) > 0.8 * len(made)


def test_the_number_of_membranes_is_not_that_of_the_pops_if_the_trace_asks_for_another():
    depth = np.linspace(0, 30e-3, 600)
    noise = 0.005 * np.random.default_rng(3).normal(size=600)
    weak = pn.Membrane(stiffness=60, precompression=0.03, friction=0.3, thickness=3e-3)
    made = Trace(depth, force_of(depth, 4e-3) + force_of(depth, 20e-3, weak) + noise)
    assert len(segment(made).pops) == 1
    found = identify(made, NEEDLE)
    assert len(found.parameters.membranes) == 2
    assert found.parameters.membranes[:, 0].max() == pytest.approx(20e-3, abs=1e-3)
    assert len(identify(made, NEEDLE, membranes=1).parameters.membranes) == 1


def test_what_no_method_can_tell_is_called_not_identifiable():
    made = trace(noise=0.01)
    early = made[: int(np.argmax(made.depth > 6.2e-3))]  # the tip is not half way in
    for estimate in identify(early, NEEDLE, membranes=1).estimates:
        if estimate.name.endswith(("stiffness", "precompression", "friction")):
            assert not estimate.identifiable, estimate


def test_linear_algebra_uses_one_thread_meanwhile_and_as_many_as_before_afterwards():
    def threads():
        return [one["num_threads"] for one in threadpoolctl.threadpool_info() if one["user_api"] == "blas"]

    with threadpoolctl.threadpool_limits(2, "blas"):
        meanwhile, before = [], threads()
        identify(trace(noise=0.01), NEEDLE, membranes=1, report=lambda _: meanwhile.extend(threads()))
        assert set(before) == {2} and set(meanwhile) == {1} and threads() == before
        first, second = one_thread("punctura.identify"), one_thread("punctura.identify")  # of two threads at once
        first.__enter__()
        second.__enter__()
        first.__exit__(None, None, None)
        assert set(threads()) == {1}
        second.__exit__(None, None, None)
        assert threads() == before
