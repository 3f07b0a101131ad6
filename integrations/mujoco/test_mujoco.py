"""punctura.mujoco with the real MuJoCo. Run by test.sh."""

import os
import subprocess
import sys
import warnings
from pathlib import Path

import numpy as np
import punctura as pn
import punctura.mujoco as pm
import pytest
from punctura.scene import ServoSettings

mujoco = pytest.importorskip("mujoco", reason="test.sh installs it")

LONG = os.environ.get("PUNCTURA_LONG") == "1"  # set by test.sh
NEEDLE = pn.Needle(1.08e-3, 0.28)
WALL = pn.Membrane(570, 0.41, 0.2, 1e-3)


@pytest.fixture(autouse=True)
def away(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """MuJoCo writes its warnings into MUJOCO_LOG.TXT in the current folder."""
    monkeypatch.chdir(tmp_path)


def scene(*heights: float, coupling: pn.Coupling | None = None) -> pn.Scene:
    """Membranes across z, each at a height of its body's frame, m; the needle goes down."""
    walls = [pn.PlacedMembrane(f"wall {i}", WALL, (0, 0, z), (0, 0, -1)) for i, z in enumerate(heights)]
    return pn.Scene("walls", NEEDLE, coupling or pn.Coupling(400, 1), walls)


def model(
    mass: float = 1e-3, timestep: float = 2e-3, joint: str = "<freejoint/>", tissue: str = "", **option: str
) -> mujoco.MjModel:
    options = " ".join(f'{key}="{value}"' for key, value in option.items())
    inertia = " ".join([f"{mass * 1e-4:g}"] * 3)
    return mujoco.MjModel.from_xml_string(
        f"""<mujoco><option timestep="{timestep}" gravity="0 0 0" {options}/><worldbody>
        <body name="tissue">{tissue}</body>
        <body name="needle" pos="0 0 0.002">{joint}<inertial mass="{mass}" pos="0 0 0" diaginertia="{inertia}"/>
        <site name="tip" zaxis="0 0 -1"/></body></worldbody></mujoco>"""
    )


def push(attached: pm.Attachment, data: mujoco.MjData, force: float, seconds: float) -> np.ndarray:
    """Steps with a constant force on the needle along z. Returns time, height and force of the needle, by steps."""
    rows = []
    needle = attached.model.body("needle").id
    for _ in range(round(seconds / attached.model.opt.timestep)):
        data.xfrc_applied[needle, 2] = force
        attached.step(data)
        rows.append((data.time, data.site_xpos[0, 2], attached.force(data)[0, 2]))
    return np.array(rows)


@pytest.mark.parametrize("integrator", ["Euler", "implicitfast", "implicit", "RK4"])
@pytest.mark.parametrize("mass", [1e-4, 1e-3, 1e-2, 1e-1])
def test_a_needle_is_held_at_2_ms_and_at_rest_its_force_is_steady(mass, integrator):
    m = model(mass, integrator=integrator)
    d = mujoco.MjData(m)
    attached = pm.attach(m, scene(0), "tip", "tissue")
    d.qvel[2] = -0.05
    pushed = push(attached, d, -0.3, 2)
    assert pushed[-100:, 2] == pytest.approx(0.3, abs=2e-3)
    released = push(attached, d, 0, 2)
    assert abs(released[-1, 2]) < 2e-3


SLIDE = '<joint type="slide" axis="0 0 1"/>'


def test_without_the_implicit_force_a_light_needle_oscillates_and_a_warning_names_mass_and_time_step():
    m = model(1e-3, joint=SLIDE)
    d = mujoco.MjData(m)
    attached = pm.attach(m, scene(0), "tip", "tissue", implicit=False)
    d.qvel[0] = -0.05
    with pytest.warns(pm.StabilityWarning, match=r"mass of 0.001 kg. With a time step of 0.002 s .* 0.0014 kg"):
        pushed = push(attached, d, -0.3, 1)
    assert np.ptp(pushed[-100:, 2]) > 0.1
    heavy = model(1e-2, joint=SLIDE)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        d = mujoco.MjData(heavy)
        attached = pm.attach(heavy, scene(0), "tip", "tissue", implicit=False)
        d.qvel[0] = -0.05
        assert np.ptp(push(attached, d, -0.3, 2)[-100:, 2]) < 1e-6


def test_without_the_implicit_force_it_is_that_of_the_core_bit_for_bit():
    m = model(1e-2, joint=SLIDE)
    d = mujoco.MjData(m)
    attached = pm.attach(m, scene(0, -2e-3), "tip", "tissue", implicit=False)
    core = pn.Insertion(pn.Scene("", NEEDLE, pn.Coupling(400, 1), scene(0, -2e-3).membranes, ServoSettings(500, 0)))
    d.qvel[0] = -0.2
    largest = 0.0
    for _ in range(500):
        mujoco.mj_kinematics(m, d)
        core.step(d.site_xpos[0], d.site_xmat[0].reshape(3, 3)[:, 2])
        attached.step(d)
        assert (attached.force(d)[0] == core.force).all()
        largest = max(largest, core.force[2])
    assert largest > 0.2


def test_the_implicit_force_is_that_of_the_core_at_the_end_of_the_step_bit_for_bit():
    m = model(2e-3, joint=SLIDE)
    d = mujoco.MjData(m)
    attached = pm.attach(m, scene(0, -2e-3), "tip", "tissue")
    core = pn.Insertion(pn.Scene("", NEEDLE, pn.Coupling(400, 1), scene(0, -2e-3).membranes, ServoSettings(500, 0)))
    core.step((0, 0, 2e-3), (0, 0, -1))  # where the needle begins
    assert attached.last_tick(d) is None
    needle, largest = m.body("needle").id, 0.0
    for k in range(800):
        d.xfrc_applied[needle, 2] = -1.0 if k < 400 else 1.0
        attached.step(d)
        tick = attached.last_tick(d)
        assert (core.step(tick.tip[0], tick.axis[0]) == tick.force[0]).all()
        mujoco.mj_kinematics(m, d)
        assert d.site_xpos[0] == pytest.approx(tick.tip[0], abs=2e-6)  # it came where it was expected
        largest = max(largest, tick.force[0, 2])
    assert largest > 0.5


def test_the_relaxation_of_the_scene_is_used():
    whole = scene(0).replace(relaxation=[pn.MaxwellBranch(120, 0.3)])
    core = pn.Insertion(whole.replace(servo=ServoSettings(500, 0)))
    core.step((0, 0, 2e-3), (0, 0, -1))  # where the needle begins
    m = model(2e-3, joint=SLIDE)
    d = mujoco.MjData(m)
    attached = pm.attach(m, whole, "tip", "tissue")
    for _ in range(400):
        d.xfrc_applied[m.body("needle").id, 2] = -0.3
        attached.step(d)
        tick = attached.last_tick(d)
        assert (core.step(tick.tip[0], tick.axis[0]) == tick.force[0]).all()
    assert tick.force[0, 2] == pytest.approx(0.3, abs=2e-3)


@pytest.mark.parametrize("mass", [1e-3, 1e-1])
def test_a_needle_that_is_welded_to_a_hand_is_held_steadily(mass):
    m = mujoco.MjModel.from_xml_string(
        f"""<mujoco><option timestep="0.002"/><worldbody><body name="tissue"/>
        <body name="hand" mocap="true" pos="0 0 0.002"/><body name="needle" pos="0 0 0.002"><freejoint/>
        <inertial mass="{mass}" pos="0 0 0.05" diaginertia="{mass * 1e-3} {mass * 1e-3} {mass * 1e-4}"/>
        <site name="tip" zaxis="0 0 -1"/></body></worldbody>
        <equality><weld body1="hand" body2="needle" solref="0.005 1"/></equality></mujoco>"""
    )
    d = mujoco.MjData(m)
    attached = pm.attach(m, scene(0), "tip", "tissue")
    forces = []
    for k in range(1500):
        d.mocap_pos[0, 2] = 0.002 - 0.008 * min(k / 500, 1)
        attached.step(d)
        forces.append(attached.force(d)[0, 2])
    assert max(forces) < 0.7 and forces[-1] > 0.4
    assert np.ptp(forces[-200:]) < 1e-6


def test_held_by_static_friction_the_needle_does_not_drift():
    m = model(1e-3)
    d = mujoco.MjData(m)
    attached = pm.attach(m, scene(0), "tip", "tissue")
    d.qvel[2] = -0.05
    push(attached, d, -0.55, 1.5)
    held = push(attached, d, -0.01, 61 if LONG else 3)  # ten times its weight, a fortieth of the friction
    settled = held[held[:, 0] > held[0, 0] + 1]
    assert np.ptp(settled[:, 1]) < 1e-6
    assert settled[-1, 2] == pytest.approx(0.01, abs=1e-6)


@pytest.mark.parametrize("integrator", ["Euler", "implicitfast", "RK4"])
def test_step_and_acting_give_the_same_bits_however_often_mujoco_calls(integrator):
    m = model(5e-3, integrator=integrator)
    d, other = mujoco.MjData(m), mujoco.MjData(m)
    attached = pm.attach(m, scene(0), "tip", "tissue")
    d.qvel[2] = other.qvel[2] = -0.3
    largest = 0.0
    for _ in range(200):
        attached.step(d)
        largest = max(largest, attached.force(d)[0, 2])
    assert largest > 0.1
    with attached.acting():
        for i in range(200):
            if i % 7 == 0:
                mujoco.mj_forward(m, other)
                mujoco.mj_forward(m, other)
            mujoco.mj_step(m, other)
    assert (d.qpos == other.qpos).all() and (attached.force(d) == attached.force(other)).all()
    assert not other.xfrc_applied.any()


def test_needle_and_tissue_get_opposite_forces_in_a_tissue_that_moves_and_turns():
    tissue = '<freejoint/><inertial mass="0.05" pos="0 0 0" diaginertia="2e-5 2e-5 2e-5"/>'
    m = model(5e-3, tissue=tissue)
    d = mujoco.MjData(m)
    attached = pm.attach(m, scene(0), "tip", "tissue")
    d.qvel[:6] = 0.02, 0.01, 0, 0.5, -0.5, 1.0
    d.qvel[8] = -0.3
    mujoco.mj_forward(m, d)

    def momentum() -> np.ndarray:
        mujoco.mj_forward(m, d)
        mujoco.mj_subtreeVel(m, d)
        bodies = [m.body("tissue").id, m.body("needle").id]
        masses, centres = m.body_mass[bodies], d.xipos[bodies]
        linear = d.subtree_linvel[bodies] * masses[:, None]
        return np.concatenate([linear.sum(0), (d.subtree_angmom[bodies] + np.cross(centres, linear)).sum(0)])

    before, largest = momentum(), 0.0
    for _ in range(300):
        attached.step(d)
        largest = max(largest, np.linalg.norm(attached.force(d)))
    assert largest > 0.1
    assert momentum()[:3] == pytest.approx(before[:3], abs=1e-12)
    # Euler's method keeps the angular momentum of two bodies only to the first order in the time step
    assert momentum()[3:] == pytest.approx(before[3:], abs=1e-7)


def test_the_frame_of_the_tissue_does_not_change_what_the_needle_feels():
    results = []
    for place in ("", 'pos="0.1 -0.2 0.3" euler="30 40 50"'):
        m = mujoco.MjModel.from_xml_string(
            f"""<mujoco><option timestep="0.002" gravity="0 0 0"/><worldbody><frame {place}><body name="tissue"/>
            <body name="needle" pos="0 0 0.002"><joint type="slide" axis="0 0 1"/><geom size="0.01" mass="0.002"/>
            <site name="tip" zaxis="0 0 -1"/></body></frame></worldbody></mujoco>"""
        )
        d = mujoco.MjData(m)
        attached = pm.attach(m, scene(0), "tip", "tissue")
        d.qvel[0] = -0.5
        for _ in range(100):
            attached.step(d)
            results.append((d.qpos[0], np.linalg.norm(attached.force(d))))
    assert max(force for _, force in results) > 0.1
    assert np.allclose(results[:100], results[100:], rtol=0, atol=1e-9)


def test_several_needles_and_membranes_on_several_bodies():
    m = mujoco.MjModel.from_xml_string(
        """<mujoco><option timestep="0.002" gravity="0 0 0"><flag contact="disable"/></option>
        <worldbody><body name="skin"/>
        <body name="vein" pos="0 0 -0.0005"><joint type="slide" axis="1 0 0" stiffness="200" damping="1"/>
        <geom size="0.003" mass="0.01"/></body>
        <body name="left" pos="0 0 0.002"><joint type="slide" axis="0 0 1" damping="1"/><geom size="0.01" mass="0.01"/>
        <site name="left tip" zaxis="1 0 -2"/></body>
        <body name="right" pos="1 0 0.002"><joint type="slide" axis="0 0 1" damping="1"/><geom size="0.01" mass="0.01"/>
        <site name="right tip" zaxis="0 0 -1"/></body></worldbody></mujoco>"""
    )
    walls = scene(0, 0)
    attached = pm.attach_needles(
        m,
        [
            pm.NeedleInTissue(walls, "left tip", {"wall 0": "skin", "wall 1": "vein"}),
            pm.NeedleInTissue(scene(0), "right tip", "skin"),
        ],
    )
    d = mujoco.MjData(m)
    for _ in range(1000):
        d.qfrc_applied[1:] = -0.5, -0.3
        attached.step(d)
    depths = attached.depths(d)
    assert [len(row) for row in depths] == [1, 1, 1]
    assert [phase.name for row in attached.phases(d) for phase in row] == ["sticking"] * 3
    assert depths[0][0] > depths[1][0] > 0
    assert abs(d.qpos[0]) > 1e-6  # the slanting needle has moved the vein aside


def test_a_force_sensor_between_robot_and_needle_feels_the_tissue():
    m = mujoco.MjModel.from_xml_string(
        """<mujoco><option timestep="0.002" gravity="0 0 0"/><worldbody><body name="tissue"/>
        <body pos="0 0 0.002"><joint type="slide" axis="0 0 1" damping="10"/><geom size="0.01" mass="0.1"/>
        <body name="needle"><geom size="0.001" mass="0.001"/><site name="tip" zaxis="0 0 -1"/></body></body>
        </worldbody><sensor><force name="felt" site="tip"/></sensor></mujoco>"""
    )
    d = mujoco.MjData(m)
    attached = pm.attach(m, scene(0), "tip", "tissue")
    for _ in range(1000):
        d.qfrc_applied[0] = -0.4
        attached.step(d)
    assert d.sensor("felt").data[2] == pytest.approx(0.4, abs=1e-4)


def test_a_saved_state_continues_with_the_same_bits_and_foreign_ones_change_nothing():
    m = model(5e-3)
    d = mujoco.MjData(m)
    attached = pm.attach(m, scene(0), "tip", "tissue")
    d.qvel[2] = -0.3
    push(attached, d, -0.2, 0.05)
    state = attached.save(d)
    first = push(attached, d, -0.2, 0.2)
    attached.restore(d, state)
    assert (push(attached, d, -0.2, 0.2) == first).all()
    twin = mujoco.MjData(m)
    attached.restore(twin, state)
    assert (push(attached, twin, -0.2, 0.2) == first).all()

    changed = model(5e-3, joint='<joint type="slide" axis="0 0 1"/>')
    other = pm.attach(changed, scene(0), "tip", "tissue")
    firmer = pm.attach(model(5e-3), scene(0, coupling=pn.Coupling(500, 1)), "tip", "tissue")
    before = attached.save(d)
    for attachment, data, bad in [
        (attached, d, b"nonsense"), (attached, d, state[:-1]), (attached, d, b""),
        (attached, d, state[:-9] + bytes([state[-9] ^ 1]) + state[-8:]),
        (attached, d, other.save(mujoco.MjData(changed))), (attached, d, firmer.save(mujoco.MjData(firmer.model))),
    ]:  # fmt: skip
        with pytest.raises(ValueError, match="state"):
            attachment.restore(data, bad)
    assert attached.save(d) == before


def test_the_robot_of_the_example_feels_two_pops_and_ends_in_the_vein():
    example = Path(__file__).with_name("example.py")
    done = subprocess.run([sys.executable, example], capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    pops = [line.split() for line in done.stdout.splitlines() if line.startswith("pop")]
    assert [words[1] for words in pops] == ["1", "2"]
    assert 4.1 < float(pops[1][-2]) < 6.0  # the whole tip has passed the wall; the back wall is 6.8 mm away
