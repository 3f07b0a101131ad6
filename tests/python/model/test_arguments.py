"""Constructors reject invalid arguments at once, with a clear message."""

import warnings

import punctura as pn
import pytest
from punctura.scene import DisplaySettings, ServoSettings
from punctura.syringe import Syringe

NEEDLE = {"diameter": 1.08e-3, "tip_angle": 0.28}
WALL = {"stiffness": 570, "precompression": 0.41, "friction": 0.2, "thickness": 1e-4}


@pytest.mark.parametrize(
    ("make", "path"),
    [
        (lambda: pn.Needle(-1, 5), "needle.diameter"),
        (lambda: pn.Needle(1e-3, 5), "needle.tip_angle"),
        (lambda: pn.Needle(float("nan"), 0.28), "needle.diameter"),
        (lambda: pn.Membrane(**WALL).replace(friction=-1), "membrane.friction"),
        (lambda: pn.Membrane(**WALL | {"thickness": float("inf")}), "membrane.thickness"),
        (lambda: pn.Coupling(0, 1), "coupling.stiffness"),
        (lambda: pn.Coupling(400, 1).replace(damping=-1), "coupling.damping"),
        (
            lambda: pn.Proxy1d(pn.ThickLaw(pn.Needle(**NEEDLE), pn.Membrane(**WALL)), pn.Coupling(400, 1), 1600),
            "period",
        ),
        (lambda: ServoSettings(rate=float("nan")), "servo.rate"),
        (lambda: ServoSettings().replace(low_pass=-1), "servo.low_pass"),
        (lambda: ServoSettings(sub_steps=1.5), "servo.sub_steps"),
        (lambda: DisplaySettings(float("nan")), "display.force_scale"),
        (lambda: pn.MaxwellBranch(float("nan"), 0.1), "coupling.relaxation.stiffness"),
        (lambda: pn.Tissue(cutting=float("nan")), "tissue.cutting"),
        (lambda: pn.PlacedMembrane("a", pn.Membrane(**WALL), [0, float("nan"), 0], [0, -1, 0]), "membrane.point"),
        (lambda: pn.PlacedMembrane("a", pn.Membrane(**WALL), [0, 0, 0], [0, 0, 0]), "membrane.inward_normal"),
    ],
)
def test_an_invalid_value_is_rejected_at_once(make, path):
    with pytest.raises(pn.ConfigurationError) as error:
        make()
    assert path in [problem.path for problem in error.value.problems]


def test_all_invalid_values_are_reported_together():
    with pytest.raises(pn.ConfigurationError) as error:
        pn.Needle(-1, 5)
    assert [problem.path for problem in error.value.problems] == ["needle.diameter", "needle.tip_angle"]


@pytest.mark.parametrize(
    ("make", "says"),
    [
        (lambda: pn.Needle(diametre=1e-3, tip_angle=0.28), "no argument diametre; did you mean diameter?"),
        (lambda: pn.Needle(1e-3), "tip_angle is missing"),
        (lambda: pn.Needle("1 mm", 0.28), "diameter must be a number, not str"),
        (lambda: pn.Needle(1e-3, 0.28, 3), "takes 2 arguments by place, not 3"),
        (lambda: pn.Needle(1e-3, diameter=1e-3, tip_angle=0.28), "diameter is given twice"),
        (lambda: pn.Membrane(570, 0.41, mu=0.2, thickness=1e-4), "no argument mu; did you mean friction?"),
        (lambda: pn.Coupling(400, damping=None), "damping must be a number, not NoneType"),
        (lambda: pn.ThickLaw(pn.Needle(**NEEDLE), pn.Needle(**NEEDLE)), "membrane must be a Membrane, not Needle"),
        (
            lambda: pn.Proxy1d(pn.ThinLaw(pn.Needle(**NEEDLE), pn.Membrane(**WALL)), pn.Coupling(400, 1), periode=1e-3),
            "no argument periode; did you mean period?",
        ),
        (lambda: ServoSettings(rate=1600, lowpass=300), "no argument lowpass; did you mean low_pass?"),
        (lambda: pn.Needle(**NEEDLE).replace(angle=0.3), "no argument angle; did you mean tip_angle?"),
    ],
)
def test_a_wrong_argument_is_named(make, says):
    with pytest.raises(TypeError) as error:
        make()
    assert says in str(error.value)
    assert "It takes (" in str(error.value) and "?." not in str(error.value)
    assert "incompatible function arguments" not in str(error.value)


@pytest.mark.parametrize(
    ("make", "says"),
    [
        (lambda: pn.Needle(1.08, 0.28), "needle.diameter = 1.08 m is unusual. If you meant 1.08 mm, write 0.00108"),
        (lambda: pn.Needle(1080, 0.28), "needle.diameter = 1080 m is unusual. If you meant 1080 um, write 0.00108"),
        (lambda: pn.Membrane(570, 0.41, 0.2, 500), "If you meant 500 um, write 0.0005"),
        (lambda: pn.Membrane(0.57, 0.41, 0.2, 1e-4), "If you meant 0.57 N/mm, write 570"),
        (lambda: pn.Membrane(570, 410, 0.2, 1e-4), "If you meant 410 mN, write 0.41"),
        (lambda: pn.Membrane(570, 0.41, 0.2, 1.0), "If you meant 1 mm, write 0.001"),
        (lambda: pn.Coupling(0.4, 1), "If you meant 0.4 N/mm, write 400"),
        (lambda: Syringe(15, 4e-6, 0, 0.5, 1e-12, 1e9), "syringe.bore = 15 m is unusual. If you meant 15 mm"),
        (lambda: Syringe(0.015, 4, 0, 0.5, 1e-12, 1e9), "If you meant 4 mL, write 4e-06"),
    ],
)
def test_a_number_in_another_unit_gives_a_warning_that_names_the_unit(make, says):
    with pytest.warns(UserWarning) as warned:
        made = make()
    assert says in str(warned[0].message)
    assert made is not None


def test_an_angle_in_degrees_is_refused_with_its_value_in_radians():
    with pytest.raises(
        pn.ConfigurationError, match=r"pi/2.*If you meant 16 degrees, write 0.2793: the angle is in rad"
    ):
        pn.Needle(1.08e-3, 16)
    with pytest.raises(pn.ConfigurationError) as error:
        pn.Needle(1.08e-3, 160)
    assert "degrees" not in str(error.value)


def test_usual_numbers_give_no_warning():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for name in pn.scene_names():
            scene = pn.load_scene(name)
            pn.Needle(scene.needle.diameter, scene.needle.tip_angle)
            for placed in scene.membranes:
                placed.membrane.replace()
            scene.coupling.replace()
