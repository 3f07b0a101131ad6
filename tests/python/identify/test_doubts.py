"""A model that does not explain its trace is named as such: what is left, where, and what could explain it."""

import json
from dataclasses import replace

import numpy as np
import punctura as pn
import pytest
from punctura.cli.identify import in_words
from punctura.identify import identify
from punctura.identify.air_noise import AirNoise
from punctura.identify.causes import Cause, both_ways, way_out
from punctura.identify.doubts import NOT_EXPLAINED, doubts
from punctura.identify.fit import Misfit, fit
from punctura.identify.intervals import Estimate, estimates
from punctura.identify.model import Model
from punctura.identify.parameters import Parameters, default_coupling, default_membrane
from punctura.identify.report import report_html
from punctura.identify.verdict import verdicts
from punctura.identify.walls import without_a_wall
from punctura.studio.trace_lines import fit_line
from punctura.trace import Trace, segment
from punctura.trace.findings import examine
from traces import MEMBRANE, NEEDLE, RATE, force_of, motion, trace


def fitted(made, drift=False):
    """K06 with one wall, fitted from the truth: no search is needed."""
    row = default_membrane()
    row[:5] = 5e-3, MEMBRANE.stiffness, MEMBRANE.precompression, MEMBRANE.friction, MEMBRANE.thickness
    start = Parameters(NEEDLE, np.array([row]), default_coupling(4000.0))
    return fit(Misfit(made, start), Model(1, rig=("drift",) if drift else ()).names, start)


def doubted(made, extensions=()):
    return doubts(made, segment(made), fitted(made), extensions)


def changed(change, seed=1, noise=8e-3, **options):
    """A trace whose force is changed: change(depth, force, going in) gives the force, N."""
    time, depth = motion(**options)
    force = change(depth, force_of(depth), np.gradient(depth) >= 0)
    return Trace(depth, force + noise * np.random.default_rng(seed).normal(size=len(depth)), time)


def pulled(ratio):
    return lambda depth, force, inward: np.where(force < 0, ratio * force, force)


def at_two_speeds():
    """Two insertions at 2 and 16 mm/s; the force grows with the speed to the power 0.15."""
    ways = [np.arange(0, 15e-3, speed / RATE) for speed in (2e-3, 16e-3)]
    depth = np.concatenate([part for way in ways for part in (way, way[::-1])])
    time = np.arange(len(depth)) / RATE
    force = force_of(depth) * (np.abs(np.gradient(depth, time)) / 5e-3 + 1e-3) ** 0.15
    return Trace(depth, force + 8e-3 * np.random.default_rng(1).normal(size=len(depth)), time)


def test_a_trace_of_the_model_itself_is_explained_in_any_white_noise():
    for seed in range(12):
        for noise in (2e-3, 20e-3):
            verdict = doubted(trace(noise=noise, seed=seed))
            assert verdict.explained.ok and verdict.sentences == () and verdict.causes == ()
    assert verdict.explained.noise == pytest.approx(20e-3, rel=0.3) and verdict.explained.air
    assert verdict.explained.runs == pytest.approx(verdict.explained.runs_of_noise, rel=0.15)


@pytest.mark.parametrize(
    ("made", "kind", "words"),
    [
        (changed(pulled(2.2)), "barbs", "resists 2.2 times as much as the way in"),
        (changed(pulled(0.5)), "asymmetric_way_out", "resists 0.5 times as much as the way in"),
        (at_two_speeds(), "rate", "The force depends on the speed"),
        (
            changed(lambda depth, force, inward: force * (1 + 0.12 * np.sin(2 * np.pi * depth / 1.5e-3))),
            "ripple",
            "with a period of 1.5 mm",
        ),
        (
            changed(lambda depth, force, inward: force + 0.15 * inward * np.clip((depth - 9e-3) / 2e-3, 0, 1)),
            "depth",
            "a wall more, or another law",
        ),
        (
            changed(lambda depth, force, inward: force - 15 * np.clip(depth - 5e-3, 0, None)),
            "same_both_ways",
            "changes with the depth, by -0.015 N a mm",
        ),
    ],
    ids=["barbs", "weak way out", "rate", "ripple", "wall more", "crosstalk"],
)
def test_what_k06_does_not_know_is_named_with_an_experiment(made, kind, words):
    verdict = doubted(made)
    assert not verdict.explained.ok and "does not explain the trace" in verdict.sentences[0]
    named = next(cause for cause in verdict.causes if cause.kind == kind)
    assert words in named.text and "To tell: " in named.text and named.share > 0.6
    assert verdict.explained.runs < 0.7 * verdict.explained.runs_of_noise
    uneven = {cause.kind for cause in verdict.causes} & {"barbs", "asymmetric_way_out"}
    assert uneven == {kind} & {"barbs", "asymmetric_way_out"}  # a wall that resists on the way in alone is none


def test_a_trace_that_another_law_may_explain_better_is_not_called_explained():
    """A sensor shows 4 % too little of the greatest force: the model leaves less than 1 % of it."""
    verdict = doubted(changed(lambda depth, force, inward: force * (1 - 0.05 * force)))
    assert verdict.explained.ok and not verdict.explained.places and not verdict.as_dict()["explained"]
    assert verdict.sentences[0].startswith("The model does not explain all: it leaves 0.00")
    assert "intervals may be too narrow" in verdict.sentences[0]


def test_a_sensor_that_is_quieter_than_its_steps_leaves_no_misfit():
    made = trace(noise=0.015)
    coarse = doubted(replace(made, force=np.round(made.force / 0.15) * 0.15))
    assert coarse.explained.ok and coarse.sentences == ()


def test_noise_of_the_depth_is_named_and_not_a_wall():
    made = trace(noise=8e-3)
    shaken = replace(made, depth=made.depth + 10e-6 * np.random.default_rng(2).normal(size=len(made)))
    verdict = doubted(shaken)
    assert not verdict.explained.ok and [cause.kind for cause in verdict.causes] == ["depth_noise"]
    told = float(verdict.causes[0].text.partition("noise of ")[2].partition(" um")[0])
    assert told == pytest.approx(10, rel=0.15)


def test_a_tremor_of_the_hand_is_no_noise_of_the_depth():
    time, depth = motion()
    shaken = depth + 0.1e-3 * np.sin(2 * np.pi * 10 * time)
    force = pulled(2.2)(shaken, force_of(shaken), None) + 8e-3 * np.random.default_rng(1).normal(size=len(depth))
    verdict = doubted(Trace(shaken, force, time))
    assert not verdict.explained.ok and verdict.causes
    assert "depth_noise" not in [cause.kind for cause in verdict.causes]


def test_the_place_that_is_not_explained_is_named():
    """A bump of 0.2 N from 11 to 13 mm on the way in."""
    bump = changed(lambda depth, force, inward: force + 0.2 * inward * ((depth > 11e-3) & (depth < 13e-3)))
    place = doubted(bump).explained.places[0]
    assert (place.kind, place.insertion) == ("in", 0)
    assert (place.shallow, place.deep) == pytest.approx((11e-3, 13e-3), abs=0.4e-3)
    assert place.force == pytest.approx(0.2, abs=0.08) and "on the way in from 11" in str(place)


def test_slow_noise_that_air_shows_is_no_misfit():
    rng, made = np.random.default_rng(3), trace(noise=8e-3, hold=1.0)
    slow = np.zeros(len(made))
    for i in range(1, len(slow)):
        slow[i] = 0.95 * slow[i - 1] + 5e-3 * rng.normal()
    assert doubted(replace(made, force=made.force + slow)).explained.ok


def test_a_model_that_is_wrong_is_not_called_explained_by_a_noise_that_short_air_does_not_exclude():
    for seed in (0, 7):
        made = changed(lambda depth, force, inward: force * (1 + 0.15 * np.sin(2 * np.pi * depth / 6e-3)), seed=seed)
        whole = segment(made)
        short = made[whole.contact - 60 : whole.exit - 5]
        air = AirNoise(short, segment(short))
        found = fitted(short)
        assert air.allows(*found.noise.most_likely()) and not air.shows(*found.noise.most_likely())
        assert not doubts(short, segment(short), found, (), air).explained.ok


def test_a_model_that_is_wrong_is_not_called_explained_by_a_drift_that_the_fit_takes_out():
    made = changed(lambda depth, force, inward: force * (1 + 0.1 * np.sin(2 * np.pi * depth / 6e-3)))
    made = examine(replace(made, force=made.force + 0.06 * made.time / made.time[-1]))
    assert "drift" in [finding.kind for finding in made.findings]
    whole = segment(made)
    assert not doubts(made, whole, fitted(made, drift=True), (), AirNoise(made, whole)).explained.ok


def test_a_way_out_that_a_wall_which_is_not_there_explains_is_named_nevertheless():
    """The fit is told to leave nothing: as if walls more had explained the asymmetric way out."""
    made = changed(pulled(0.5))
    found = fitted(made)

    class Explains(Misfit):
        def forces(self, parameters):
            return smooth

    smooth = changed(pulled(0.5), noise=0.0).force
    there = Explains(made, found.parameters)
    left = replace(found, misfit=there, residuals=smooth - made.force)
    verdict = doubts(made, segment(made), left, ("tail",))
    assert verdict.explained.ok and [cause.kind for cause in verdict.causes] == ["asymmetric_way_out"]
    assert not verdict.as_dict()["explained"]
    assert "do not trust its walls" in verdict.sentences[0]
    assert doubts(made, segment(made), left, ("set",)).causes == ()


def test_crosstalk_that_other_walls_explain_is_not_called_an_asymmetric_way_out():
    made = changed(lambda depth, force, inward: force + 15 * np.clip(depth - 5e-3, 0, None))
    ways = both_ways(made, segment(made), fitted(made))
    assert ways.growth == pytest.approx(15, rel=0.3) and way_out(ways.ratio, ways.growth)[0] == "same_both_ways"
    assert both_ways(changed(pulled(0.5)), segment(made), fitted(made)).growth == 0


def test_a_drift_that_is_fitted_makes_no_asymmetric_way_out():
    made = trace(noise=8e-3)
    drifting = replace(made, force=made.force + 0.02 * made.time)
    start = fitted(made).parameters
    whole = fit(Misfit(drifting, start), (*Model(1).names, "drift"), start)
    assert whole.parameters.get("drift") == pytest.approx(0.02, rel=0.1)
    assert doubts(drifting, segment(drifting), whole, ()).sentences == ()


@pytest.mark.parametrize(("place", "kind"), [(-20e-3, "wall_in_air"), (20e-3, "wall_beyond")])
def test_a_wall_that_cannot_be_there_is_named_and_one_beyond_is_left_out_first(place, kind):
    made = trace(noise=8e-3)
    start = fitted(made).parameters
    far = default_membrane()
    far[:5] = place, 100.0, 0.1, 0.1, 1e-3
    two = replace(start, membranes=np.vstack((start.membranes, far)))
    whole = fit(Misfit(made, two), ("offset",), two)
    assert kind in [one.kind for one in doubts(made, segment(made), whole, ()).causes]
    begun = replace(segment(made), contact=None)  # the air behind the way out tells it, too
    doubted = doubts(made, begun, whole, ())
    assert kind in [one.kind for one in doubted.causes] and not doubted.as_dict()["explained"]
    if kind == "wall_beyond":
        (fewer,) = without_a_wall(whole, segment(made))
        assert np.array_equal(fewer.membranes, start.membranes)


@pytest.mark.parametrize("causes", [(), (Cause("wall_in_air", 0.0, "The model has 0.1 N of tissue in air"),)])
def test_text_json_report_and_page_agree_on_what_is_explained(causes):
    found = identify(trace(noise=8e-3)[::4], NEEDLE, 1)
    found = replace(found, doubts=found.doubts.beside(*causes))
    said = [NOT_EXPLAINED in text for text in (in_words(found), report_html(found).decode())]
    said += [not found.as_dict()["explained"]["explained"], not fit_line(found).explained]
    assert said == [bool(causes)] * 4


def test_the_command_names_it_and_draws_it(punctura, tmp_path):
    made = changed(pulled(2.2))[::6]
    rows = np.column_stack([made.time, 1e3 * made.depth, made.force])
    np.savetxt(tmp_path / "a.csv", rows, delimiter=",", header="time_s,depth_mm,force_N", comments="")
    needle = f"diameter_mm={NEEDLE.diameter * 1e3},tip_angle_rad={NEEDLE.tip_angle}"
    done = punctura("identify", tmp_path / "a.csv", "--needle", needle, "--membranes", 1, "--json",
                    "--report", tmp_path / "a.html")  # fmt: skip
    verdict = json.loads(done.stdout)
    assert verdict["explained"]["causes"][0]["kind"] == "barbs"
    assert any("The way out is asymmetric" in text for text in verdict["verdicts"])
    assert "The way out is asymmetric" in (tmp_path / "a.html").read_text()


def of(made, *estimates, explained=True):
    segments = segment(made)
    return verdicts(estimates, made, segments, fitted(made), AirNoise(made, segments), explained)


def unknown(name):
    return Estimate(name, 1.0, None, None, "-")


def test_no_advice_asks_for_what_the_trace_has():
    made = trace(noise=8e-3, times=2, hold=70.0)
    kinds = ("stiffness", "friction", "thickness", "set", "surface")
    names = [*(f"membrane[0].{kind}" for kind in kinds), "coupling_stiffness", "drift"]
    text = " ".join(of(made, *map(unknown, names)))
    assert all(name in text for name in names)
    for wrong in ("withdrawal", "withdraw,", "and withdraw", "before contact", "second time", "through", "rest for"):
        assert wrong not in text, text
    short = made[: int(np.argmax(made.depth > 7e-3))]
    assert "insert until the tip is through" in of(short, unknown("membrane[0].stiffness"))[0]


def test_no_experiment_is_advised_for_a_parameter_of_a_model_that_does_not_explain_the_trace():
    made = trace(noise=8e-3)
    sentence = of(made, unknown("relaxation_1_time"), unknown("membrane[0].friction"), explained=False)[0]
    assert "relaxation_1_time, membrane[0].friction" in sentence and "rest for" not in sentence


@pytest.mark.parametrize(("deepest", "advice"), [(7e-3, "insert until the tip is through"), (15e-3, "another law")])
def test_a_wall_that_never_lets_go_is_not_told_to_be_gone_through(deepest, advice):
    time, depth = motion(deepest=deepest)
    wall = pn.ProfileLaw([0, 10e-3], [-0.1, -0.6], [0.05, 0.2], 0.5e-3)
    force = -pn.Proxy1d(wall, pn.Coupling(4000, 1.0), 1 / RATE).run(depth - 5e-3).force
    made = Trace(depth, force + 5e-3 * np.random.default_rng(1).normal(size=len(depth)), time)
    segments, unknown = segment(made), [Estimate("membrane[0].stiffness", 400.0, None, None, "N/m")]
    said = verdicts(unknown, made, segments, fitted(made), AirNoise(made, segments))
    (told,) = [one for one in said if "stiffness" in one]
    assert advice in told and ("the tip went 3.5 times its length" in told) == (deepest == 15e-3)


def test_an_offset_that_may_be_as_large_as_the_force_is_not_identifiable():
    made = trace()
    offset = estimates(fitted(made), outwards=False)[-1]
    assert offset.name == "offset" and offset.identifiable and offset.widest == float(np.ptp(made.force)) < 2
    assert not replace(offset, low=-33.0, high=33.0).identifiable


def test_a_tip_that_a_soft_spring_keeps_in_the_wall_is_told_to_go_deeper():
    time, depth = motion()
    wall, row = pn.Membrane(600, 3.0, 0.2, 0.5e-3), default_membrane()
    row[:5] = 5e-3, wall.stiffness, wall.precompression, wall.friction, wall.thickness
    force = -pn.Proxy1d(pn.ThickLaw(NEEDLE, wall), pn.Coupling(300, 1.0), 1 / RATE).run(depth - 5e-3).force
    made = Trace(depth, force + 5e-3 * np.random.default_rng(1).normal(size=len(depth)), time)
    start = Parameters(NEEDLE, np.array([row]), default_coupling(300.0))
    found = fit(Misfit(made, start), ["coupling_stiffness", "offset"], start)
    segments, unknown = segment(made), [Estimate("membrane[0].stiffness", 600.0, None, None, "N/m")]
    said = verdicts(unknown, made, segments, found, AirNoise(made, segments))
    assert any("insert until the tip is through" in one for one in said) and not segments.pops


def test_a_way_out_that_resists_more_may_be_the_sensor():
    kind, text = way_out(1.3)
    assert kind == "barbs" and "sensor" in text and "weights" in text


@pytest.mark.parametrize("seed", [1, 2])
def test_a_hum_that_is_sampled_slowly_is_no_drift(seed):
    made = trace(noise=8e-3, seed=seed)
    hum = 0.03 * np.sin(2 * np.pi * 0.7 * made.time + seed)
    (said,) = [one for one in of(replace(made, force=made.force + hum)) if "about the model" in one]
    assert "swings about the model by ±0.02" in said
    rate = float(said.partition(" N, ")[2].partition(" times a second, as the hum")[0])
    assert rate == pytest.approx(0.7, abs=0.04)  # it is looked for in steps of a quarter of a period in the trace
    walk = 0.03 * np.cumsum(np.random.default_rng(seed).normal(size=len(made))) / np.sqrt(len(made))
    assert not any("swings about" in one for one in of(replace(made, force=made.force + walk)))


def test_a_model_with_as_many_parameters_as_the_trace_has_stretches_cannot_be_tested():
    few = trace()[::30]
    explained = doubted(few).explained
    assert explained.ok and not explained.whole and len(explained.blocks.left) <= len(fitted(few).u)
    assert explained.sentence().startswith("It cannot be tested whether the model explains the trace")
    assert not doubted(few).as_dict()["explained"] and doubted(trace()[::5]).explained.whole


def test_a_size_that_is_unusual_for_an_insertion_is_named():
    small = examine(replace(trace(), force=trace().force * 1e-6))
    [finding] = [one for one in small.findings if one.kind == "wrong_unit"]
    assert "1000 times too small, or this is another test than the insertion" in finding.text
