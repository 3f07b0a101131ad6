"""A wrong argument of any function or method of the core is named, and the right word is suggested."""

import numpy as np
import punctura as pn
import punctura._core as core
import pytest
from punctura.simulation import Experiment, Hand, RecordedMotion, Strokes, Target

SCENE = pn.load_scene("k06-fig10")
MEMBRANE = SCENE.membranes[0].membrane
INSERTION = pn.Insertion(SCENE)
LINE = pn.Proxy1d(pn.ThickLaw(SCENE.needle, MEMBRANE), SCENE.coupling, 1 / 1600)
DOWN = (0, -1, 0)
FRICTION = "membrane[0].friction"


@pytest.mark.parametrize(
    ("call", "says"),
    [
        (lambda: LINE.step(positon=1e-3), "Proxy1d.step(): there is no argument positon; did you mean p? It takes ("),
        (
            lambda: INSERTION.step((0, 0, 0), aixs=DOWN),
            "Insertion.step(): there is no argument aixs; did you mean axis? It takes (",
        ),
        (
            lambda: INSERTION.run([(0, 0, 0)], DOWN, progres=True),
            "there is no argument progres; did you mean progress? It takes (",
        ),
        (lambda: INSERTION.step((0, 0, 0)), "Insertion.step(): axis is missing."),
        (lambda: INSERTION.step((0, 0), DOWN), "p must be three numbers, not tuple of length 2."),
        (lambda: INSERTION.peek(np.zeros((3, 1)), DOWN), "p must be three numbers, not ndarray of shape (3, 1)."),
        (lambda: LINE.step("1 mm"), "Proxy1d.step(): p must be a number, not str. It takes (p: float)"),
        (lambda: LINE.run([0], True), "takes 1 argument by place, not 2; name the others: progress."),
        (lambda: LINE.run([0], p=[0]), "p is given twice."),
        (lambda: pn.Insertion(scen=SCENE), "Insertion(): there is no argument scen; did you mean scene?"),
        (lambda: Hand(stifness=300), "Hand(): there is no argument stifness; did you mean stiffness? It takes ("),
        (lambda: Experiment(SCENE, 3), "motion must be a Strokes or a RecordedMotion or a Target, not int."),
        (
            lambda: Experiment(SCENE, Strokes(DOWN, DOWN), axis=(0, 1)),
            "axis must be three numbers or None, not tuple",
        ),
        (lambda: core.Rival("dahl", {"friction": "1 N"}), "dahl.friction must be a number"),
        (lambda: LINE.step.__self__.__class__.step(3, 4), "Proxy1d.step(): needs an object of Proxy1d"),
        (lambda: core.Fleet((0, -1, 0)).step([], -1), "Fleet.step(): an argument has a wrong type or"),
        (lambda: setattr(LINE, "state", 3), "Proxy1d.state(): state must be bytes, not int."),
        (lambda: SCENE.replace(membranes=[MEMBRANE]), "membranes[0] must be a PlacedMembrane, not Membrane."),
        (lambda: pn.Tissue(profile=[(0, 0, 0), (1, -1)]), "profile[1] must be three numbers, not tuple of length 2."),
        (lambda: pn.Tissue(profile=np.zeros((3, 8))), "profile[0] must be three numbers, not ndarray of shape (8,)."),
        (lambda: pn.Tissue(profile=[(0, 0, "1 N")]), "profile[0] must be three numbers, not tuple with int, str."),
        (lambda: pn.Tissue(grip_table=[0, 1]), "grip_table[0] must be two numbers, not int."),
        (lambda: pn.Tissue(profile="liver"), "profile must be a list of [float, float, float], not str."),
        (lambda: SCENE.replace(membranes=None), "membranes must be a list of PlacedMembrane, not NoneType."),
        (
            lambda: pn.Proxy1d(LINE, SCENE.coupling, 1e-3, solver=1),
            "solver must be 'paper' or 'exact', not int. It takes (law: ThinLaw | ThickLaw | ProfileLaw | TissueLaw, "
            "coupling: Coupling, period: float, solver: 'paper' | 'exact' (optional))",
        ),
        (lambda: core.tube_resistance(bore=1e-3, lenght=1), "tube_resistance(): there is no argument lenght; did you"),
        (lambda: pn.Needle(1e-3), "Needle(): tip_angle is missing."),
        (
            lambda: pn.ThinLaw(SCENE.needle, MEMBRANE).bounds(deth=0),
            "there is no argument deth; did you mean depth? It takes (",
        ),
    ],
)
def test_the_wrong_argument_of_a_call_is_named(call, says):
    with pytest.raises(TypeError) as error:
        call()
    assert says in str(error.value)
    assert "incompatible function arguments" not in str(error.value)


def functions():
    """Every function and method of the core, accessors of properties included."""
    for value in vars(core).values():
        members = vars(value).values() if isinstance(value, type) else ()
        for found in (value, *members):
            for function in (found, getattr(found, "fget", None), getattr(found, "fset", None)):
                if hasattr(function, "__nb_signature__"):
                    yield function


def test_every_function_explains_a_wrong_number_of_arguments():
    nothing = object()
    named = [f for f in functions() if not getattr(f, "__name__", "").startswith("__")]
    assert len(named) > 300
    for function in named:
        try:
            function(*[nothing] * 40)
        except TypeError as error:
            assert "incompatible function arguments" not in str(error), function


@pytest.mark.parametrize("numbers", [["1e-3"], [1e-3j], np.zeros(1, "M8[s]"), np.zeros(1, [("x", float)])])
def test_only_real_numbers_are_taken_as_positions(numbers):
    before = LINE.state
    with pytest.raises(TypeError, match="p must hold real numbers, not"):
        LINE.run(numbers)
    assert LINE.state == before
    with pytest.raises(TypeError, match="position must hold real numbers, not"):
        pn.simulate(SCENE, numbers)


HALF = np.ma.masked_array([0.0, 1e-3, 0.0], mask=[False, True, False])
FED = core.FedDevice(1000)
NOT_REAL = [HALF, np.array([0, 1e-3 + 1e-3j, 0]), np.zeros(3, np.complex64), [0, 1j, 0], [0, np.ma.masked, 0]]


@pytest.mark.parametrize("numbers", NOT_REAL, ids=repr)
@pytest.mark.parametrize(
    ("call", "name"),
    [
        (FED.feed, "position"),
        (lambda numbers: FED.feed((0, 0, 0), numbers), "axis"),
        (lambda numbers: INSERTION.step(numbers, DOWN), "p"),
        (lambda numbers: FED.feed((0, 0, 0), motor_temperature=numbers[1]), "motor_temperature"),
        (lambda numbers: LINE.peek(numbers[1]), "p"),
        (lambda numbers: pn.Needle(numbers[1], 0.3), "diameter"),
    ],
)
def test_masked_and_complex_numbers_are_refused_where_one_or_three_numbers_are_taken(call, name, numbers):
    with pytest.raises(TypeError, match=rf"{name}(\[1\])? must be (a number|three numbers), not \w+"):
        call(numbers)


@pytest.mark.parametrize("numbers", NOT_REAL[:4], ids=repr)
@pytest.mark.parametrize("column", ["time", "sequence", "motor_temperature"])
def test_masked_and_complex_columns_are_refused(column, numbers):
    with pytest.raises((TypeError, ValueError), match=f"{column} (must hold real numbers, not complex|has masked)"):
        core.ReplayDevice(np.zeros((3, 3)), DOWN, 1000, **{column: numbers})


def test_real_numbers_of_any_type_are_taken():
    whole = np.ma.masked_array([0.0, 1e-3, 0.0], mask=False)
    for numbers in (whole, np.zeros(3, np.float32), [np.int64(0), np.array(1e-3), np.float16(0)], (True, 0, 0.0)):
        assert len(FED.feed(numbers)) == 3


MANY = 10**12


@pytest.mark.parametrize(
    ("call", "says"),
    [
        (lambda: LINE.run(np.broadcast_to(0.0, MANY)), "the columns of 1000000000000 ticks need"),
        (lambda: LINE.run(np.broadcast_to(np.float32(0), MANY)), "the columns of 1000000000000 ticks need"),
        (lambda: INSERTION.run(np.broadcast_to(np.zeros(3), (MANY, 3)), DOWN), "the columns of 1000000000000 ticks"),
        (lambda: LINE.run(np.broadcast_to(0.0, (2, MANY))), "p: 2000000000000 numbers in a copy need .* in parts"),
        (
            lambda: pn.ThinLaw(SCENE.needle, MEMBRANE).bounds(np.broadcast_to(np.float32(0), MANY)),
            "depth: 1000000000000 numbers in a copy need .* GB of memory, and .* GB are free",
        ),
    ],
)
def test_an_array_without_memory_of_its_own_is_refused_before_it_is_copied(call, says):
    before = LINE.state
    with pytest.raises(MemoryError, match=says):
        call()
    assert LINE.state == before


def test_an_object_whose_constructor_did_not_run_is_told():
    class Own(pn.Needle):
        def __init__(self):
            pass

    with pytest.warns(RuntimeWarning), pytest.raises(TypeError, match="its __init__ has not run"):
        _ = Own().diameter


def test_a_huge_number_is_shown_short():
    with pytest.raises(ValueError, match=r"p holds 1e\+308 m: positions must be within 1000 km"):
        LINE.step(1e308)


def test_a_run_without_end_is_refused():
    made = Experiment(SCENE, Target((0, 5e-3, 0)))
    with pytest.raises(ValueError, match="duration must be from 0 to 1e9 s"):
        made.run(1e18)
    with pytest.raises(MemoryError, match=r"the columns of \d+ ticks need .* GB of memory, .* Make the run in parts"):
        made.run(1e9)


@pytest.mark.parametrize(
    ("call", "says"),
    [
        (lambda: pn.load_scene(3), "a scene is a file or the name of a ready scene, not int"),
        (lambda: pn.save_scene("out.toml", SCENE), "save_scene needs a Scene, then a path; the first argument is str"),
        (lambda: pn.Ticks([1, 2]), "columns must be a dict of column names to arrays, not list"),
        (lambda: pn.save_scene(SCENE, 3), "save_scene needs a Scene, then a path; the second argument is int"),
        (
            lambda: pn.simulate(SCENE, None),
            "motion must be an array of positions, m, or the name of a motion file, not",
        ),
        (lambda: pn.Ticks({3: [0.0]}), "the names of columns must be str, not int: 3"),
        (lambda: SCENE.with_values({FRICTION: 1j}), r"membrane\[0\].friction must be a number; replace\(\) sets words"),
        (lambda: SCENE.with_values({FRICTION: np.complex64(1)}), r"membrane\[0\].friction must be one real number"),
        (lambda: SCENE.with_values({FRICTION: np.array("3")}), r"membrane\[0\].friction must be one real number"),
        (lambda: pn.Ticks({"time": [0.0]}, membranes="skin"), "membranes must be a list of names, not str"),
        (lambda: SCENE.with_values({FRICTION: np.ones(1)}), r"membrane\[0\].friction must be one real number"),
        (lambda: pn.grid([1]), "grid needs a dict of paths to lists of numbers, not list"),
    ],
)
def test_an_argument_of_another_type_is_told_in_a_sentence(call, says):
    with pytest.raises(TypeError, match=says):
        call()


def test_a_target_takes_only_finite_places():
    target = Target((0, 0, 0))
    experiment = Experiment(SCENE, target)
    for move in (Target, target.move_to, experiment.move_to):
        for place in ((0, float("nan"), 0), (0, 0, 2e6)):
            with pytest.raises(ValueError, match="must be three finite numbers, m, within 1000 km"):
                move(place)


def test_a_recorded_motion_takes_only_finite_places_and_ascending_times():
    for time, y, says in (
        ([0, 1], 2e6, "sample 1: position must be three finite numbers, m, within 1000 km"),
        ([0, 0], 0.0, "sample 1: time must be finite and ascend"),
        ([0, np.nan], 0.0, "sample 1: time must be finite and ascend"),
    ):
        with pytest.raises(ValueError, match=says):
            RecordedMotion(time, [(0, 0, 0), (0, y, 0)])


def test_a_number_that_no_float_holds_is_told_with_its_path():
    with pytest.raises(ValueError, match=r"membrane\[0\].friction is too large for a number") as error:
        SCENE.with_values({FRICTION: 10**400})
    assert isinstance(error.value.__cause__, OverflowError)


def test_strokes_name_the_number_that_is_no_place():
    for number in (float("nan"), 2e6):
        with pytest.raises(pn.ConfigurationError, match=r"strokes.end\[1\] = .*: must be finite and within 1000 km"):
            Strokes((0, 0, 0), (0, number, 0))
