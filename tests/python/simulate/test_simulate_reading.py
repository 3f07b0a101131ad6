"""Forms of a motion file that are as good as the plain one."""

import pytest
from punctura import simulate

from .simulate_motions import AXIS_HEADER, HEADER, rows_of, strokes


@pytest.fixture
def expected(write, tmp_path):
    simulate("k06-fig10", write([HEADER, *rows_of(*strokes(800))]), tmp_path / "expected.csv")
    return (tmp_path / "expected.csv").read_bytes()


LINES = [HEADER, *rows_of(*strokes(800))]


def quoted(line):
    return ",".join(f'"{field}"' for field in line.split(","))


FORMS = {
    "Windows line ends": "".join(line + "\r\n" for line in LINES),
    "a byte-order mark": "\ufeff" + "\n".join(LINES),
    "no end of the last line": "\n".join(LINES),
    "blank lines at the end": "\n".join(LINES) + "\n\n  \n\n",
    "a quoted header": "\n".join([quoted(LINES[0]), *LINES[1:]]),
    "quoted numbers": "\n".join(quoted(line) for line in LINES),
    "spaces after the commas": "\n".join(line.replace(",", ", ") for line in LINES),
}


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("block_bytes", [1000, 1 << 20])
def test_the_result_does_not_depend_on(expected, tmp_path, monkeypatch, form, block_bytes):
    monkeypatch.setattr("punctura.simulation.motion_file.BLOCK_BYTES", block_bytes)
    path = tmp_path / "other.csv"
    path.write_bytes(FORMS[form].encode())
    simulate("k06-fig10", path, tmp_path / "out.csv")
    assert (tmp_path / "out.csv").read_bytes() == expected


def test_a_motion_of_one_sample_is_one_tick(write, tmp_path):
    summary = simulate("k06-fig10", write([HEADER, "0.5,0,0.001,0"]), tmp_path / "out.csv")
    assert (summary.ticks, summary.motion_rate_hz, summary.resampled) == (1, None, False)
    _, row = (tmp_path / "out.csv").read_text().splitlines()
    assert row.startswith("0.5,0,0.001,0,0,0,0,-0.001,")


def test_a_tiny_and_a_huge_axis_are_directions_too(write, tmp_path):
    for length in ("1e-300", "1e300"):
        lines = [f"{line},0,-{length},0" for line in rows_of(*strokes(800))]
        simulate("k06-fig10", write([AXIS_HEADER, *lines]), tmp_path / f"{length}.csv")
    small, large = ((tmp_path / f"{n}.csv").read_text().replace(n, "") for n in ("1e-300", "1e300"))
    assert [line.split(",")[7:] for line in small.splitlines()] == [line.split(",")[7:] for line in large.splitlines()]
