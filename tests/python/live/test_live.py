"""A live run from Python and from the command line, on the simulated device."""

import json
import os
import signal
import subprocess
import sys

import numpy as np
import punctura as pn
import pytest
from heed import heed_signals
from punctura._core import Fault, ForceLimits, GateLimits, ServoLoop, SimulatedDevice, describe
from punctura.cli._headless import in_words, status_text
from punctura.live import RunSummary, fit_conditioning, fit_direction, run_live, stroke_ends, strokes_through
from punctura.simulation import Strokes
from waiting import PATIENCE_S, wait_until

SCENE = pn.load_scene("k06-fig10")
STROKES = Strokes([0, 5e-3, 0], [0, -10e-3, 0], count=1, duration=1.0, variation=0.0)


def simulated(ticks=4000, **kw):
    return SimulatedDevice(STROKES, real_time=False, ticks=ticks, **kw)


def test_a_run_ends_with_the_device_and_its_summary_counts_every_tick():
    summary = run_live(simulated(), SCENE)
    assert (summary.ticks, summary.lost, summary.fault) == (4000, 0, "")
    assert summary.felt_peak_N == pytest.approx(0.73, abs=0.01)
    assert summary.deepest_m[0] > 5e-3
    assert summary.state == "active"


def test_a_limit_that_acts_is_counted_and_reported():
    summary = run_live(simulated(), SCENE, limits=ForceLimits(max_force=0.5))
    assert summary.felt_peak_N == pytest.approx(0.5)
    assert summary.limited_ticks == summary.limited_by["peak"] > 100
    assert summary.limits_in_words.startswith("the peak limit for ")


def test_the_limit_that_cuts_the_force_is_told_in_the_line_and_at_the_end():
    limits = ForceLimits(continuous_force=0.1, continuous_time=2)
    summary = run_live(simulated(ticks=2400), SCENE, limits=limits)  # ends while the needle is inside
    assert summary.limited_by["continuous"] > 0 and summary.limited_by["peak"] == 0
    assert "the long-run limit for " in in_words(summary)
    assert summary.limit == "long-run limit" and summary.model_force_N > np.linalg.norm(summary.force_N)
    assert f"N (of {summary.model_force_N:.2f} N: long-run limit)" in status_text(summary)


def test_a_new_run_goes_on_with_what_the_motors_have_given():
    device = SimulatedDevice(STROKES, seed=3, real_time=False, ticks=4000)
    assert device.spent == 0
    limits = ForceLimits(continuous_force=0.1, continuous_time=60)
    run_live(device, SCENE, limits=limits)
    spent = device.spent
    assert spent > 0.05
    loop = ServoLoop(device, SCENE, limits=limits)
    assert 0 < loop.spent <= spent
    device.spent = 123.0
    assert ServoLoop(device, SCENE, limits=limits).spent == 123.0


def test_a_dead_man_button_that_nobody_holds_gives_no_force():
    summary = run_live(simulated(), SCENE, gate=GateLimits(dead_man=1))
    assert (summary.felt_peak_N, summary.state) == (0.0, "waiting")


def test_a_fault_ends_the_run_and_says_what_to_do():
    summary = run_live(simulated(ticks=0), SCENE, gate=GateLimits(max_speed=1.6e-3))
    assert summary.fault == describe(Fault.position_jump)
    assert "calibrate" in summary.fault
    assert summary.force_N == (0.0, 0.0, 0.0)


def test_strokes_go_from_in_front_of_all_membranes_to_behind_them():
    for name in pn.scene_names():
        scene = pn.load_scene(name)
        summary = run_live(
            SimulatedDevice(
                strokes_through(scene, 1), real_time=False, ticks=8000, axis=scene.membranes[0].inward_normal
            ),
            scene,
        )
        assert summary.fault == ""
        assert summary.state == "active"
        for deepest, placed in zip(summary.deepest_m, scene.membranes, strict=True):
            law = pn.ThickLaw(scene.needle, placed.membrane)
            assert deepest > law.X + law.U, f"{name}: {placed.name} is not gone through"


def test_strokes_end_behind_a_wall_whichever_way_its_normal_is_written():
    scene = pn.load_scene("k06-fig12")
    front, *others = scene.membranes
    assert others
    turned = [pn.PlacedMembrane(w.name, w.membrane, w.point, [-c for c in w.inward_normal]) for w in others]
    other = pn.Scene(scene.name, scene.needle, scene.coupling, [front, *turned])
    np.testing.assert_allclose(stroke_ends(other), stroke_ends(scene), atol=1e-12)


def test_the_summary_counts_snapshots_that_never_came():
    summary = RunSummary.of(SCENE, "x", 1600.0)
    loop = ServoLoop(simulated(ticks=1000), SCENE)
    listener = loop.listen(64)
    loop.start()
    wait_until(lambda: loop.device.finished)
    loop.stop()
    summary.add(listener.read())
    assert summary.ticks == 64
    assert summary.lost + listener.lost == 1000 - 64


def test_headless_prints_a_summary_a_program_can_read(punctura):
    done = punctura("run", "k06-fig12", "--headless", "--duration", "1.5", "--json")
    assert done.status == 0, done.stderr
    summary = json.loads(done.stdout)
    assert summary["lost"] == 0
    assert 0 < summary["ticks"] <= 2500
    assert summary["device"].startswith("simulated")


def test_a_recorded_run_holds_every_tick_and_runs_again_to_the_last_bit(punctura, tmp_path):
    file = tmp_path / "run.parquet"
    done = punctura("run", "k06-fig12", "--headless", "--duration", "2", "--record", str(file), "--json")
    assert done.status == 0, done.stderr
    ticks = json.loads(done.stdout)["ticks"]
    assert f"run.parquet: {ticks} ticks recorded, 0 lost" in done.stderr
    again = punctura("replay", str(file))
    assert again.status == 0, again.stderr
    assert "identical" in again.stdout


def test_a_recording_that_cannot_be_written_is_told_before_anything_moves(punctura, tmp_path):
    done = punctura("run", "--headless", "--duration", "1", "--record", str(tmp_path / "run.csv"))
    assert done.status == 2
    assert "must end in .parquet" in done.stderr


def test_without_a_page_the_studio_says_how_to_build_it(punctura, tmp_path):
    done = punctura("run", "--page", str(tmp_path))
    assert done.status == 1
    assert "npm run build" in done.stderr


def test_what_needs_headless_says_so(punctura):
    done = punctura("run", "--json")
    assert done.status == 2
    assert "needs --headless" in done.stderr and "button" not in done.stderr


@pytest.mark.skipif(os.name != "posix", reason="sends signals")
@pytest.mark.parametrize("name", ["SIGTERM", "SIGHUP", "SIGINT"])
def test_a_signal_ends_the_run_with_the_force_off(name):
    command = [sys.executable, "-m", "punctura", "run", "--headless", "--scene-filter"]
    process = subprocess.Popen(
        command, stderr=subprocess.PIPE, stdout=subprocess.PIPE, text=True, preexec_fn=heed_signals
    )
    strong = "at most 3.3 N, 0.88 N rms in any 10 s"
    assert process.stderr.readline() == f"punctura: Venipuncture on PHANTOM Omni, simulated, {strong}; Ctrl-C ends it\n"
    process.send_signal(getattr(signal, name))
    _, report = process.communicate(timeout=PATIENCE_S)
    last = f"punctura: {'interrupted' if name == 'SIGINT' else f'ended by {name}'}; the force is off\n"
    assert report.endswith(last) and "Traceback" not in report
    assert process.returncode == 128 + getattr(signal, name)


def test_devices_tells_every_back_end_and_its_state(punctura):
    done = punctura("devices", "--json")
    assert done.status == 0, done.stderr
    entries = {entry["backend"]: entry for entry in json.loads(done.stdout)}
    assert entries["simulated"]["state"] == "available"
    assert all(entry["state"] == "available" or entry["detail"] for entry in entries.values())
    lines = punctura("devices").stdout.splitlines()
    assert len(lines) <= 2 * len(entries) and "simulated        available: PHANTOM Omni" in lines


def test_positions_are_conditioned_for_the_encoders_of_the_device():
    scene, note = fit_conditioning(SCENE, simulated())
    assert (scene.servo.conditioning, scene.servo.encoder_step) == ("line_fit", 0.055e-3)
    assert "0.055 mm" in note

    class Silent:
        class info:
            encoder_step = float("nan")

    assert fit_conditioning(SCENE, Silent) == (SCENE, "")


def test_a_device_without_orientation_takes_the_direction_from_motion():
    class Plain:
        class info:
            has_orientation = False

    scene, note = fit_direction(SCENE, Plain)
    assert scene.direction == "motion" and "no orientation" in note
    assert fit_direction(SCENE, simulated()) == (SCENE, "")
