"""Absurd scene files are rejected with a clear message and in short time, whatever they contain."""

import pytest
from punctura import ConfigurationError, load_scene


def problems(path):
    with pytest.raises(ConfigurationError) as caught:
        load_scene(path)
    return [str(problem) for problem in caught.value.problems]


@pytest.mark.parametrize("number", ["1e400", "1e1000000", "1e999999999", "1e99999999999999999999"])
def test_a_number_beyond_a_double_is_told_as_infinite(write, number):
    path = write(("thickness_mm = 1.0", f"thickness_mm = {number}"))
    assert problems(path) == ["membrane[0].thickness_mm = inf: must be a finite number"]


@pytest.mark.parametrize("number", ["1e-400", "1e-999999999", "1e-99999999999999999999", "0e99999999999999999999"])
def test_a_number_below_a_double_is_0(write, number):
    assert load_scene(write(("thickness_mm = 1.0", f"thickness_mm = {number}"))).membranes[0].membrane.thickness == 0


def test_a_fraction_of_900_digits_is_rounded_once(write):
    third = "0." + "3" * 900
    scene = load_scene(
        write(("thickness_mm = 1.0", f"thickness_mm = {third}"), ("friction = 0.2", f"friction = {third}"))
    )
    assert scene.membranes[0].membrane.friction == 1 / 3
    assert scene.membranes[0].membrane.thickness == float("0.000" + "3" * 900)


@pytest.mark.parametrize("number", ["9" * 5000, "0x" + "f" * 4998])
def test_a_number_of_thousands_of_digits_is_told_with_its_line(write, number):
    path = write(("thickness_mm = 1.0", f"thickness_mm = {number}"))
    assert problems(path) == ["line 17: a number or a key has 5000 characters; the limit is 1000"]


@pytest.mark.parametrize("deep", ["[" * 5000 + "]" * 5000, "[\n" * 5000, "{a=" * 5000 + "1" + "}" * 5000])
def test_lists_and_tables_a_thousand_deep_are_reported(write, deep):
    (problem,) = problems(write(("thickness_mm = 1.0", f"thickness_mm = {deep}")))
    assert problem.endswith(": lists and tables are nested more than 16 deep")
    assert problem.startswith("line ")


def test_a_key_of_a_hundred_thousand_parts_is_reported(write):
    path = write(("friction = 0.2", "friction." + "a." * 100_000 + "b = 0.2"))
    assert problems(path) == ["line 16: a key has more than 16 dots"]


def test_dots_and_brackets_in_texts_and_comments_are_not_counted(write):
    dots = "[." * 90
    scene = load_scene(write(('"skin"', f"'''{dots}'''  # {dots}"), ('"wall"', f'"""\\"{dots}"""')))
    assert [m.name for m in scene.membranes] == [dots, '"' + dots]


def test_a_name_that_would_fill_a_page_is_refused(write):
    assert len(load_scene(write(('name = "test"', f'name = "{"x" * 200}"'))).name) == 200
    path = write(('name = "test"', f'name = "{"x" * 201}"'), ('name = "wall"', f'name = "{"y" * 100_000}"'))
    scene, wall = problems(path)
    assert scene.endswith(": must have at most 200 characters; it has 201")
    assert wall.startswith("membrane[1].name = ") and wall.endswith("; it has 100000") and len(wall) < 300


@pytest.mark.parametrize(
    "key", ['"membrane.x"', '"membrane[7].friction"', '"needle.gauge"', '""', '"a\\nb"', '"\u00b2"']
)
def test_a_key_in_quotes_is_told_in_quotes_and_is_nobody_elses_path(write, key):
    (problem,) = problems(write(text=f"{key} = 1\n" + write().read_text()))
    assert problem.startswith(f"{key} = 1: unknown key; ")


def test_thousands_of_unknown_keys_are_all_told_in_the_order_of_the_file(write):
    keys = [f"key{i}" for i in range(4000)]
    report = problems(write(("[coupling]", "\n".join(f"{key} = 1" for key in keys) + "\n[coupling]")))
    assert [line.split(" = ")[0] for line in report] == [f"needle.{key}" for key in keys]


def test_of_ten_thousand_membranes_it_is_told_that_they_are_too_many(write):
    report = problems(write(text=write().read_text() + "[[membrane]]\n" * 10_000))
    assert report[0] == "membrane: there may be at most 64 membranes"
    assert len(report) < 1000


def test_a_file_larger_than_256_kib_is_not_read(write):
    comment = "#" * 99 + "\n"
    assert problems(write(text=write().read_text() + comment * 2622)) == ["is larger than 256 KiB: no scene needs that"]
    assert load_scene(write(text=write().read_text() + comment * 2600)).name == "test"


def test_a_long_value_is_cut_in_the_message_and_whole_in_the_problem(write):
    path = write(("point_mm = [0, 0, 0]", f"point_mm = {[0] * 5000}"))
    with pytest.raises(ConfigurationError) as caught:
        load_scene(path)
    (problem,) = caught.value.problems
    assert problem.value == [0] * 5000
    assert len(str(problem)) < 300
    assert str(problem).endswith("... (15000 characters): must be three numbers, [x, y, z] (mm)")
