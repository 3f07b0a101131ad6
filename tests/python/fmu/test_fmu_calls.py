"""Calls out of order, unknown variables and wrong numbers: an error with a sentence, and nothing changes."""

from ctypes import c_double, c_int, c_size_t, c_uint32

import numpy as np
import pytest
from fmu_slave import ERROR, INPUTS, OK, Slave, parameter

both = pytest.mark.parametrize("version", [2, 3])
T = 1 / 1600
DEEP, DOWN = (0.0, -2e-3, 0.0), (0.0, -1.0, 0.0)
STATES = ("before the initialization", "during the initialization", "between initialization and end", "after the end")
CALLS = {
    "EnterInitializationMode": (lambda needle: needle.enter(5.0), STATES[:1]),
    "ExitInitializationMode": (lambda needle: needle.leave(), STATES[1:2]),
    "SetFloat64": (lambda needle: needle.set([1], [0.0]), STATES[:3]),
    "GetFloat64": (lambda needle: needle.get([7])[0], STATES[1:]),
    "DoStep": (lambda needle: needle.step(0.0, T), STATES[2:3]),
    "Terminate": (lambda needle: needle("Terminate"), STATES[2:3]),
    "SaveState": (lambda needle: OK if needle.save() else ERROR, STATES),
    "Reset": (lambda needle: needle("Reset"), STATES),
}


def in_state(folder, version, state):
    needle = Slave(folder, version)
    moves = (lambda: OK, lambda: needle.enter(), lambda: needle.leave(), lambda: needle("Terminate"))
    for move in moves[: STATES.index(state) + 1]:
        assert move() == OK
    return needle


@both
@pytest.mark.parametrize("state", STATES)
@pytest.mark.parametrize("name", CALLS)
def test_each_call_is_allowed_in_its_states_only(tmp_path, version, state, name):
    call, allowed = CALLS[name]
    needle = in_state(tmp_path, version, state)
    status = call(needle)
    assert (status == OK) == (state in allowed)
    assert len(needle.log) == (status != OK)
    if version == 3 and status != OK:
        assert needle.log == [f"fmi3{name} was called {state}; it is allowed only {' or '.join(allowed)}"]


def test_a_percent_sign_in_the_name_of_a_folder_begins_a_code_only_before_two_digits(tmp_path, monkeypatch):
    monkeypatch.setattr(Slave, "made", {})
    (tmp_path / "5 % wet").mkdir()
    Slave(tmp_path / "5 % wet", 2).started()


@both
def test_an_end_of_the_initialization_in_mid_run_does_not_reset_the_needle(tmp_path, version):
    needle, other = Slave(tmp_path, version).started(), Slave(tmp_path, version).started()
    for k in range(400):
        for one in (needle, other):
            one.set(INPUTS, (0.0, 1e-3 - 1e-5 * k, 0.0, *DOWN))
            assert one.step(k * T, T) == OK
    assert needle.force()[1] > 0.1
    assert needle.leave() != OK and needle.enter(5.0) != OK
    needle.step(400 * T, T), other.step(400 * T, T)
    assert needle.force() == other.force()


@both
@pytest.mark.parametrize("step", [T, T / 4, 16 * T])
@pytest.mark.parametrize("wrong", [(np.nan, *DEEP[1:], *DOWN), (*DEEP, 0.0, 0.0, 0.0), (*DEEP, 0.0, np.inf, 0.0)])
def test_an_input_that_is_no_number_is_refused_in_each_step_and_blocks_no_later_one(tmp_path, version, step, wrong):
    needle, other = Slave(tmp_path, version).started(), Slave(tmp_path, version).started()
    for k in range(8):
        for one in (needle, other):
            one.set(INPUTS, (0.0, -1e-4 * k, 0.0, *DOWN))
            assert one.step(k * step, step) == OK
        before = needle.force()
        needle.set(INPUTS, wrong)
        assert needle.step((k + 1) * step, step) == ERROR
        assert needle.force() == before == other.force()
    assert len(needle.log) == 8


@both
def test_a_step_that_fails_after_some_ticks_changes_nothing(tmp_path, version):
    needle, other = Slave(tmp_path, version).started(), Slave(tmp_path, version).started()
    turned = (0.0, 1.0, 0.0)
    for one in (needle, other):
        one.set(INPUTS, (*DEEP, *DOWN))
        assert one.step(0, 4 * T) == OK
    needle.set(INPUTS, (*DEEP, *turned))
    assert needle.step(4 * T, 4 * T) == ERROR  # the axis would be 0 at the second of four ticks
    for one in (needle, other):
        one.set(INPUTS, (0.0, -3e-3, 0.0, *DOWN))
        assert one.step(4 * T, 4 * T) == OK
    assert needle.save() == other.save()


@both
def test_a_state_holds_the_parameters_and_the_place_in_the_run(tmp_path, version):
    stiffness = parameter("membrane[0].stiffness")
    needle, other = Slave(tmp_path, version), Slave(tmp_path, version)
    needle.enter()
    assert needle.set([stiffness], [900.0]) == OK
    initial = needle.save()
    assert other.restore(initial) == OK  # into another instance, before its initialization
    assert other.get([stiffness]) == (OK, [900.0])

    def run(one, begin):
        forces = []
        for k in range(begin, 300):
            one.set(INPUTS, (0.0, -1e-5 * k, 0.0, *DOWN))
            assert one.step(k * T, T) == OK
            forces.append(one.force())
        return forces

    assert needle.leave() == OK and other.leave() == OK
    forces = run(needle, 0)
    assert run(other, 0) == forces
    assert needle.restore(initial) == OK and needle.leave() == OK  # back from the run
    assert needle.step(0.0, T) == OK
    running = needle.save()
    plain = Slave(tmp_path, version).started()
    assert plain.restore(running) == OK  # over other parameters
    assert plain.get([stiffness]) == (OK, [900.0])
    assert run(plain, 1) == run(needle, 1)
    assert plain.restore(running[:-1]) != OK and plain.restore(running[:40] + b"x" + running[41:]) != OK
    another = Slave(tmp_path, version, "venipuncture")
    assert another.restore(running) != OK


@both
def test_only_variables_of_the_description_are_read_and_set(tmp_path, version):
    needle = Slave(tmp_path, version)
    needle.enter()
    for reference in (11, 99, 103, 100 + 4 * 64, 999, 5000, 2**31, 2**31 + 100, 2**32 - 1):
        for kind in ("Float64", "Int32", "Boolean"):
            assert needle.get([reference], kind)[0] == ERROR
        assert needle.set([reference], [1.0]) == ERROR
    assert len(needle.log) == 9 * 4
    for reference, kind in ((102, "Float64"), (10, "Int32"), (1, "Int32"), (102, "Boolean"), (1000, "Int32")):
        assert needle.get([reference], kind)[0] == ERROR
    assert needle.get([102], "Int32") == (OK, [0]) and needle.get([10], "Boolean") == (OK, [True])
    for reference in (0, 7, 100, 101):
        assert needle.set([reference], [0.0]) == ERROR
    if version == 3:
        assert needle.log[0] == "fmi3GetFloat64: this FMU has no variable with the value reference 11"
        assert needle.log[-1].endswith("the variable with the value reference 101 is no input and no parameter")
    needle.leave()
    assert needle.set([10], [False], "Boolean") == ERROR and needle.set([1000], [1e-3]) == ERROR


@both
@pytest.mark.parametrize("wrong", [999, 7, 1000])  # unknown, an output, a parameter in the run
def test_a_set_with_one_wrong_reference_sets_none(tmp_path, version, wrong):
    needle = Slave(tmp_path, version).started()
    before = needle.save()
    assert needle.set([1, 2, wrong], [0.5, np.nan, 1.0]) == ERROR
    assert needle.save() == before and needle.step(0.0, T) == OK


def test_a_wrong_derivative_sets_none(tmp_path):
    needle = Slave(tmp_path, 2).started()
    before = needle.save()
    references, orders, values = (c_uint32 * 2)(1, 2), (c_int * 2)(1, 2), (c_double * 2)(1.0, 1.0)
    assert needle("SetRealInputDerivatives", references, c_size_t(2), orders, values) == ERROR
    assert needle.save() == before


def test_a_wrong_parameter_ends_the_initialization_with_all_problems(tmp_path):
    needle = Slave(tmp_path)
    needle.enter()
    needle.set([parameter("membrane[0].friction"), parameter("needle.diameter")], [7.25, -1e-7])
    assert needle.leave() == ERROR
    (text,) = needle.log
    assert "membrane[0].friction = 7.25: " in text and "needle.diameter = -1e-07: " in text
    assert needle.set([parameter("membrane[0].friction"), parameter("needle.diameter")], [0.2, 1e-3]) == OK
    assert needle.leave() == OK


@pytest.mark.parametrize("name", ["EnterEventMode", "EnterStepMode", "GetString", "UpdateDiscreteStates"])
def test_what_this_fmu_does_not_have_is_an_error_with_a_sentence(tmp_path, name):
    needle = Slave(tmp_path).started()
    assert needle(name) == ERROR
    assert needle.log == [f"fmi3{name}: this FMU has no such variables, modes or derivatives"]
