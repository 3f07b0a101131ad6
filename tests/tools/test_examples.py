"""The examples do what their first lines say."""

import ast
from pathlib import Path

import pytest

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"


@pytest.mark.parametrize("name", ["cpp/06_own_device.cpp", "python/06_own_device.py"])
def test_a_device_of_your_own_takes_60_lines(name):
    assert len((EXAMPLES / name).read_text().splitlines()) < 80


@pytest.mark.parametrize("name", ["cpp/06_own_device.cpp", "python/06_own_device.py"])
def test_a_device_of_your_own_asks_for_real_time_priority_and_is_paced_without_bursts(name):
    """Without both, ordinary load on the computer causes `missed_deadline`."""
    loop = (EXAMPLES / name).read_text().split("run(")[-1]
    assert loop.index("make_realtime(") < loop.index("pacer") < loop.index("pacer.wait()")


def test_a_law_with_memory_and_time_and_all_that_is_done_with_it_takes_60_lines():
    text = (EXAMPLES / "cpp/08_healing_law.cpp").read_text()
    assert len(text.splitlines()) <= 60
    assert all(part in text for part in ("dt", "Scene", "ServoLoop", "for_each_block", "ofstream"))


def test_a_servo_loop_takes_ten_lines_in_cpp():
    body = (EXAMPLES / "cpp/05_servo_loop.cpp").read_text().split("int main() {\n")[1].split("\n}\n")[0]
    assert sum(not line.lstrip().startswith("//") for line in body.splitlines()) == 10


def test_a_servo_loop_takes_ten_lines_in_python():
    text = (EXAMPLES / "python/05_servo_loop.py").read_text()
    lines = {node.lineno for node in ast.walk(ast.parse(text)) if isinstance(node, ast.stmt)}
    docstring_and_imports = {node.lineno for node in ast.parse(text).body[:4]}
    assert len(lines - docstring_and_imports) <= 10


def test_every_numbered_example_is_in_the_table():
    table = (EXAMPLES / "README.md").read_text()
    for path in [*EXAMPLES.glob("cpp/*.cpp"), *EXAMPLES.glob("python/*.py")]:
        assert f"({path.parent.name}/{path.name})" in table
