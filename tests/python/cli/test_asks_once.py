"""All that a trace file does not state is asked in one message, with the whole command."""

import numpy as np
from punctura.cli._app import build_app
from traces import trace
from typer.testing import CliRunner


def asked(*words):
    told = CliRunner().invoke(build_app("identify"), ["identify", *map(str, words)])
    return told, f"{told.exception}"


def test_needle_columns_and_units_are_asked_at_once_with_the_whole_command(tmp_path):
    made, file = trace(), tmp_path / "my trace.csv"
    np.savetxt(file, np.column_stack((made.depth, made.force)), delimiter=",", header="a,load", comments="")
    told, text = asked(file, "--membranes", 2, "--unit", "force=stone", "--json")
    assert told.exit_code and "--needle is missing" in text and "'stone' is no unit of the force" in text
    command = text.split("The whole command: ")[1]
    assert command == (
        f"punctura identify '{file}' --membranes 2 --json --needle diameter_mm=D,tip_angle_deg=A "
        "--column depth=NAME --unit depth=UNIT --unit force=UNIT"
    )
