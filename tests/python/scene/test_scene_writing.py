"""A saved scene is loaded again unchanged, bit for bit."""

import math
from decimal import Decimal

from hypothesis import given
from hypothesis import strategies as st
from punctura import (
    Coupling,
    MaxwellBranch,
    Membrane,
    Needle,
    PlacedMembrane,
    Scene,
    Tissue,
    load_scene,
    save_scene,
    scene_names,
)
from punctura.files.units import UNITS, from_si, to_si
from punctura.scene import DisplaySettings, ServoSettings
from punctura.scene.build import _number as toml_number


def plain(scene):
    """All values of a scene, for a comparison."""
    laws = [(m.stiffness, m.precompression, m.friction, m.thickness) for m in (p.membrane for p in scene.membranes)]
    places = [(p.name, tuple(p.point), tuple(p.inward_normal)) for p in scene.membranes]
    needle = (scene.needle.diameter, scene.needle.tip_angle, scene.direction)
    servo = scene.servo
    beyond = scene.relaxation, [placed.tissue for placed in scene.membranes]
    coupling = scene.coupling.stiffness, scene.coupling.damping
    return scene.name, needle, coupling, servo, laws, places, scene.display, beyond


positive = st.floats(1e-9, 1e9)


@st.composite
def tissues(draw):
    steps = draw(st.lists(st.floats(1e-6, 1e-2), min_size=1, max_size=8))
    depths = [sum(steps[:i]) for i in range(len(steps))]
    numbers = {"tip_length": positive, "tail_length": positive, "cutting": positive}
    numbers |= {"tail_floor": st.floats(0, 1), "set": st.floats(0, 1)}
    given = {name: draw(values) for name, values in numbers.items() if draw(st.booleans())}
    kind = draw(st.sampled_from(["linear", "table", "profile"]))
    if kind == "table":
        return Tissue("table", grip_table=[(y, draw(st.floats(0, 1e3))) for y in depths], **given)
    if kind == "profile":
        return Tissue(profile=[(q, -draw(st.floats(0, 1e3)), draw(st.floats(0, 1e3))) for q in depths], **given)
    return Tissue(**given)


names = st.text(st.characters(exclude_categories=["Cc", "Cs"]), max_size=40)


@st.composite
def scenes(draw):
    thickness = st.one_of(st.just(0.0), st.floats(1e-12, 1.0))  # thinner, no double holds the slope of the band
    membrane = st.builds(Membrane, positive, positive, st.floats(1e-6, 0.5), thickness)
    vector = st.tuples(*[st.floats(-1e3, 1e3)] * 3)
    placed = st.builds(
        PlacedMembrane,
        names,
        membrane,
        vector,
        vector.filter(any),
        tissue=st.one_of(st.just(Tissue()), tissues()),
    )
    return Scene(
        draw(names),
        Needle(draw(positive), draw(st.floats(1e-6, 1.0))),
        Coupling(draw(positive), draw(positive)),
        draw(st.lists(placed, min_size=1, max_size=3)),
        ServoSettings(
            draw(st.floats(100, 1e5)),
            draw(positive),
            draw(st.sampled_from(["exact", "paper"])),
            draw(st.sampled_from(["low_pass", "line_fit"])),
            draw(st.floats(0, 1e-3)),
            draw(st.sampled_from([1, 4])),
        ),
        draw(st.sampled_from(["stylus", "motion"])),
        DisplaySettings(draw(st.one_of(st.just("automatic"), st.just(1.0), st.floats(1e-6, 1)))),
        relaxation=draw(st.lists(st.builds(MaxwellBranch, positive, st.floats(1e-4, 1e4)), max_size=2)),
    )


@given(scene=scenes())
def test_a_saved_scene_is_the_same_to_the_last_bit(tmp_path_factory, scene):
    path = tmp_path_factory.mktemp("scene") / "saved.toml"
    save_scene(scene, path)
    assert plain(load_scene(path)) == plain(scene)


def test_every_ready_scene_survives_being_saved(tmp_path):
    for name in scene_names():
        save_scene(load_scene(name), tmp_path / "saved.toml")
        assert plain(load_scene(tmp_path / "saved.toml")) == plain(load_scene(name))


@given(value=st.floats(allow_nan=False, allow_infinity=False), unit=st.sampled_from(["mm", "N_per_mm", "N", "rad"]))
def test_a_number_goes_to_its_unit_and_back_unchanged(value, unit):
    written = Decimal(toml_number(from_si(value, UNITS[unit])))
    assert math.copysign(1, to_si(written, UNITS[unit])) == math.copysign(1, value)
    assert to_si(written, UNITS[unit]) == value


def test_a_scene_is_saved_in_the_keys_of_the_file_with_plain_numbers(tmp_path):
    save_scene(load_scene("k06-fig10"), tmp_path / "saved.toml")
    text = (tmp_path / "saved.toml").read_text()
    for line in ("diameter_mm = 1.08", "tip_angle_rad = 0.28", "stiffness_N_per_mm = 0.57", "rate_hz = 1600.0"):
        assert line in text.splitlines()


def test_saving_over_a_scene_leaves_one_file(tmp_path):
    for name in ("k06-fig10", "k06-fig11"):
        save_scene(load_scene(name), tmp_path / "saved.toml")
    assert [p.name for p in tmp_path.iterdir()] == ["saved.toml"]
    assert load_scene(tmp_path / "saved.toml").name == "K06 Fig. 11"
