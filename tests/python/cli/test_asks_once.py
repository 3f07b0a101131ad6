"""All that a trace file does not state is asked in one message, with the whole command."""

from pathlib import Path

import numpy as np
import pytest
import typer
from punctura import Needle
from punctura.cli._app import build_app
from punctura.cli._trace import needle_of, reading_of
from traces import trace
from typer.testing import CliRunner


def asked(*words):
    answer = CliRunner().invoke(build_app("identify"), ["identify", *map(str, words)])
    return answer, f"{answer.exception}"


def test_needle_columns_and_units_are_asked_at_once_with_the_whole_command(tmp_path):
    made, file = trace(), tmp_path / "my trace.csv"
    np.savetxt(file, np.column_stack((made.depth, made.force)), delimiter=",", header="a,load", comments="")
    answer, text = asked(file, "--membranes", 2, "--unit", "force=stone", "--json")
    assert answer.exit_code and "--needle is missing" in text and "'stone' is no unit of the force" in text
    command = text.split("The whole command: ")[1]
    assert command == (
        f"punctura identify '{file}' --membranes 2 --json --needle diameter_mm=D,tip_angle_deg=A "
        "--column depth=NAME --unit depth=UNIT --unit force=UNIT"
    )


def test_a_needle_alone_is_asked_for_with_the_whole_command_too(tmp_path):
    made, file = trace(), tmp_path / "a.csv"
    np.savetxt(file, np.column_stack((made.depth, made.force)), delimiter=",", header="depth_m,force_N", comments="")
    answer, text = asked(file, "--scene", tmp_path / "b.toml")
    assert answer.exit_code and text.startswith("--needle is missing")
    assert text.endswith(f"{file} --scene {tmp_path / 'b.toml'} --needle diameter_mm=D,tip_angle_deg=A")
    answer, text = asked(file, "--unit", "force=mN", "--column", "depth=x", "--order", "depth")
    stated = "--unit force=mN --order depth --needle diameter_mm=D,tip_angle_deg=A --column depth=NAME"
    assert "there is no column 'x' for the depth" in text and text.endswith(stated)
    answer = CliRunner().invoke(build_app("rivals"), ["rivals", str(file), "--unit", "force=stone"])
    assert "punctura rivals" in f"{answer.exception}" and f"{answer.exception}".endswith("--unit force=UNIT")


def test_speeds_are_stated_as_a_list_with_times():
    def speeds(text):
        return reading_of(speed=text).speeds

    assert speeds("4") == ((0.0, 0.004),) and speeds(None) == ()
    assert speeds("4,0@4,-4@5.5") == ((0.0, 0.004), (4.0, 0.0), (5.5, -0.004))
    for wrong in ("fast", "4@1", "4,0@5,1@5", "nan", "4,,1@2"):
        with pytest.raises(typer.BadParameter, match="mm/s, with growing times"):
            speeds(wrong)
    with pytest.raises(typer.BadParameter, match="and --depth-file, too"):
        reading_of(speed="4", depth_file=Path("depth.csv"))


@pytest.mark.parametrize(
    "wrong",
    ["diameter_mm=1,2,tip_angle_deg=20", "diameter=1.2", "1.2", "diameter_mm=1.2", "diameter_mm=x,tip_angle_deg=20",
     "diameter_mm=1.2,tip_angle_deg=20,tip_angle_rad=0.3"],
)  # fmt: skip
def test_a_needle_that_is_not_understood_is_shown_how(wrong):
    with pytest.raises(typer.BadParameter, match=r"must be diameter_mm=1\.2,tip_angle_deg=20 .*decimal point"):
        needle_of(wrong)


def test_a_needle_of_a_wrong_unit_is_told_in_the_units_of_the_option(capsys):
    assert needle_of("diameter_mm=1.2, tip_angle_deg=20") == Needle(1.2e-3, np.radians(20))
    assert capsys.readouterr().err == ""
    needle_of("diameter_mm=0.0012,tip_angle_rad=0.3")
    answer = capsys.readouterr().err
    assert "warning: the needle is unusual: 0.0012 mm thick" in answer and "SI units" not in answer
