"""Predictions: the second insertion from the first, and a trace from the others of a folder."""

import json
from dataclasses import replace

import numpy as np
import pytest
from punctura.identify import Rig, identify
from punctura.identify.depth_noise import with_quiet_depth
from punctura.rivals import Layer, Rival, compare_trace, fit_rival, hold_out
from punctura.rivals.comparison import better_in_words
from punctura.rivals.hold_out import REPEAT, another_trace, fitted, means, second_insertion
from punctura.rivals.kinds import kinds
from punctura.rivals.layers import path_of, resistance
from punctura.trace import Trace, TraceError, segment
from traces import NEEDLE, trace

NEEDLE_WORDS = f"diameter_mm={NEEDLE.diameter * 1e3},tip_angle_rad={NEEDLE.tip_angle}"
NOISE = 8e-3


@pytest.fixture(autouse=True)
def two_rivals(monkeypatch):
    """Two rivals are enough here, and take a second less each."""
    few = {name: kinds()[name] for name in ("exponential", "sign_of_velocity")}
    monkeypatch.setattr(hold_out, "kinds", lambda: few)


def made(surface=5e-3, seed=1, times=1, noise=NOISE):
    whole = trace(noise=0.0, surface=surface, times=times, hold=0.3)
    few = whole[::5]
    return Trace(few.depth, few.force + noise * np.random.default_rng(seed).normal(size=len(few)), few.time, "made")


def test_the_second_insertion_of_the_models_own_trace_is_predicted_to_the_noise_and_rivals_are_worse():
    twice = made(times=2)
    predicted = {one.name: one for one in second_insertion(twice, NEEDLE, 1)}
    assert predicted["k06"].rmse == pytest.approx(NOISE, rel=0.15)
    assert predicted["exponential"].rmse > predicted["k06"].rmse < predicted["sign_of_velocity"].rmse
    peak = float(np.abs(twice.force[twice.strokes == 1]).max())
    assert predicted["k06"].rmse_share == pytest.approx(predicted["k06"].rmse / peak) and REPEAT in predicted
    errors = [one.rmse for one in second_insertion(twice, NEEDLE, 1)]
    assert errors == sorted(errors)


def test_what_changes_in_the_second_insertion_is_a_prediction_error_and_not_fitted():
    twice = made(times=2)
    weaker = Trace(twice.depth, np.where(twice.strokes == 1, 0.6, 1.0) * twice.force, twice.time)
    predicted = {one.name: one for one in second_insertion(weaker, NEEDLE, 1)}
    missing = 0.4 * float(np.sqrt(np.mean(twice.force[twice.strokes == 1] ** 2)))
    assert predicted["k06"].rmse == pytest.approx(missing, rel=0.1)


def test_rivals_get_the_depth_without_its_noise_as_k06_does():
    twice = trace(noise=NOISE, times=2, hold=0.3)[::4]
    shaken = replace(twice, depth=twice.depth + 10e-6 * np.random.default_rng(2).normal(size=len(twice)))
    quiet = with_quiet_depth(shaken)[0]
    assert quiet.depths is not None and with_quiet_depth(quiet)[0] is quiet
    kind = kinds()["sign_of_velocity"]
    compared = compare_trace(shaken, [kind.name, "k06"], needle=NEEDLE, with_chatter=False)
    assert np.array_equal(compared.trace.depth, quiet.depth)
    assert compared.row(kind.name).rmse == fit_rival(kind, quiet, segment(quiet)).rmse
    again = compare_trace(shaken, [kind.name], identified=identify(shaken, NEEDLE, 1), with_chatter=False)
    assert again.row(kind.name).rmse == compared.row(kind.name).rmse
    known = fitted(shaken, NEEDLE, 1, lambda _: None)
    layers = next(one for one in known.rivals if one.name == kind.name).layers
    assert layers == fit_rival(kind, quiet, segment(quiet)).layers
    every = np.ones(len(shaken), bool)
    predicted = hold_out._forces(known, shaken, 0.0, every)
    assert np.array_equal(predicted[kind.name][1], resistance(layers, path_of(quiet, segment(quiet))))


def test_a_stated_noise_of_the_depth_holds_for_the_predicted_trace_and_for_the_table():
    exact = trace(noise=NOISE, times=2, hold=0.3)[::5]  # at 40 Hz the noise is not estimated
    shaken = replace(exact, depth=exact.depth + 10e-6 * np.random.default_rng(2).normal(size=len(exact)))
    known = fitted(shaken, NEEDLE, 1, lambda _: None, Rig(depth_noise=10e-6))
    force = known.found.fit.misfit.forces(known.found.parameters)
    every = np.ones(len(shaken), bool)
    shift = 1e-3
    deeper = replace(shaken, depth=shaken.depth + shift)
    for predicted in (hold_out._forces(known, shaken, 0.0, every), hold_out._forces(known, deeper, shift, every)):
        assert predicted["k06"][1] == pytest.approx(force, abs=0.1 * NOISE)
    table = compare_trace(shaken, ["k06"], needle=NEEDLE, identified=known.found, with_chatter=False)
    assert table.row("k06").force == pytest.approx(force, abs=0.1 * NOISE)
    assert np.abs(known.found.fit.misfit.depth_error.mean).max() > 0.5 * NOISE  # so the table can be wrong


def test_one_insertion_cannot_be_held_out():
    with pytest.raises(TraceError, match="has one insertion"):
        second_insertion(made(), NEEDLE, 1)


def test_each_trace_of_a_folder_is_predicted_at_its_own_contact_without_its_own_fit():
    traces = {name: made(surface, seed) for name, surface, seed in (("a", 4e-3, 1), ("b", 5e-3, 2), ("c", 6e-3, 3))}
    known = {name: fitted(one, NEEDLE, 1, lambda _: None) for name, one in traces.items()}
    found = another_trace(known)
    k06 = {one.trace: one for one in found if one.name == "k06"}
    assert set(k06) == {"a", "b", "c"} and len(found) == 3 * 4
    for name, one in k06.items():
        assert len(one.force) == len(traces[name])
        assert one.rmse < 0.1 * np.abs(traces[name].force).max()  # the contact is known to two samples
    twice_as_strong = dict(known)
    strong = fitted(Trace(traces["c"].depth, 2 * traces["c"].force, traces["c"].time), NEEDLE, 1, lambda _: None)
    twice_as_strong["c"] = strong
    predicted = {one.trace: one for one in another_trace(twice_as_strong) if one.name == "k06"}
    assert predicted["c"].rmse > 0.3 * np.sqrt(np.mean(strong.trace.force**2))  # its own fit is not used
    mean_of = {one["name"]: one for one in means(found)}
    assert mean_of["k06"]["rmse_N"] == pytest.approx(np.mean([one.rmse for one in k06.values()]))
    with pytest.raises(TraceError, match="at least 2 traces"):
        another_trace({"a": known["a"]})


def write(path, one):
    rows = np.column_stack([one.time, 1e3 * one.depth, one.force])
    np.savetxt(path, rows, delimiter=",", header="time_s,depth_mm,force_N", comments="", fmt="%.8g")


def test_the_command_predicts_an_insertion_and_a_folder(punctura, tmp_path):
    write(tmp_path / "twice.csv", made(times=2))
    needle = NEEDLE_WORDS.replace(",", "+-0.03,")
    common = ("--needle", needle, "--membranes", 1, "--hold-out", "--rig", "depth_noise_um=0")
    done = punctura("identify", tmp_path / "twice.csv", *common, "--json")
    names = [one["name"] for one in json.loads(done.stdout)["hold_out"]]
    assert done.status == 0 and sorted(names) == ["exponential", "k06", REPEAT, "sign_of_velocity"]
    folder = tmp_path / "folder"
    folder.mkdir()
    for i in range(2):
        write(folder / f"{i}.csv", made(4e-3 + i * 1e-3, seed=i))
    (folder / "broken.csv").write_text("time_s,depth_mm,force_N\n")
    done = punctura("identify", folder, *common)
    assert done.status == 1 and "Mean over 2 traces" in done.stdout and "broken.csv: " in done.stdout
    assert punctura("identify", folder, *common, "--out", tmp_path / "out").status == 2
    done = punctura("identify", folder, *common[:-1], "depth_noise_um=-1")
    assert done.status == 2 and "rig.depth_noise" in done.stderr and "broken.csv" not in done.stderr


@pytest.mark.statistics
def test_a_rival_that_explains_the_trace_better_is_named_and_only_then(monkeypatch):
    """The second trace is made by a rival: an exponential rise, and a friction that grows with the depth."""
    monkeypatch.setattr("punctura.rivals.comparison.kinds", hold_out.kinds)
    plain = made()
    sentence = better_in_words(identify(plain, NEEDLE, 1))
    assert sentence.startswith("No rival does better: ") and sentence.endswith("(punctura rivals).")
    numbers = {"scale": 0.05, "growth": 900.0, "friction": 0.1, "friction_slope": 40.0, "puncture": 3e-3}
    path = path_of(plain, segment(plain))
    noise = NOISE * np.random.default_rng(4).normal(size=len(plain))
    force = Layer(5e-3, Rival("exponential", numbers)).resistance(path) + noise
    sentence = better_in_words(identify(Trace(plain.depth, force, plain.time), NEEDLE, 1))
    assert sentence.startswith("Another model does better: exponential")
