"""No cell of a CSV table becomes a formula in a spreadsheet, and a file's name as text is fit for a terminal."""

import csv
import io

import punctura as pn
import pyarrow as pa
import pytest
from hypothesis import given
from hypothesis import strategies as st
from punctura.files.cells import csv_line, text_cell
from punctura.files.names import as_text
from punctura.ticks.files import save

SIGNS = "=+-@\uff1d\uff0b\uff0d\uff20"


def parts(text, separator):
    """The cells of a program that expects this separator. A quote that opens no cell is a letter for it."""
    return [cell for row in csv.reader(io.StringIO(text, newline=""), delimiter=separator) for cell in row]


def is_formula(cell):
    return cell.lstrip('\t\r\n "\u00a0\ufeff\u200b')[:1] in tuple(SIGNS)


@pytest.mark.parametrize("sign", SIGNS)
@pytest.mark.parametrize(
    "before", ["", "\n", "\r", "\t", " ", "\u00a0", "\ufeff", "a;", "a; ", 'a;"', "a\n", "a\r\n ", "a\t", ";;", '"']
)
def test_a_sign_is_never_the_first_of_a_cell(before, sign):
    text = f"{before}{sign}1+1"
    kept = text_cell(text)
    assert kept.replace("'", "") == text and "'" in kept
    for separator in ",;\t":
        assert not [cell for cell in parts(csv_line(["name", text_cell(text), 1.5]), separator) if is_formula(cell)]


@given(st.text(st.sampled_from(SIGNS + ";\t\r\n \"',a\u200b\ufeff"), max_size=12))
def test_no_text_becomes_a_formula(text):
    for separator in ",;\t":
        assert not [cell for cell in parts(csv_line([text_cell(text), "end"]), separator) if is_formula(cell)]
    assert text_cell(text_cell(text)) == text_cell(text)


def test_numbers_and_usual_words_stay_as_they_are():
    assert csv_line([-0.5, -3, None, text_cell("O'Neill; a-b, 3 mm")]) == '-0.5,-3,,"O\'Neill; a-b, 3 mm"\n'


def test_a_table_with_words_holds_no_formula_and_keeps_its_numbers(tmp_path):
    save(pa.table({"run": ["=cmd()", 'a "b", c', "x;+1"], "force_N": [-0.5, 1e-17, None]}), tmp_path / "t.csv")
    rows = list(csv.reader((tmp_path / "t.csv").open(newline="")))
    assert rows == [["run", "force_N"], ["'=cmd()", "-0.5"], ['a "b", c', "1e-17"], ["x;'+1", ""]]


def test_what_no_scene_may_have_as_its_name_is_replaced():
    wall = pn.load_scene("k06-fig10").membranes
    name = as_text(b"a\x1b[31m\nb\xff\xc2\x9b \xc3\xa9.csv")
    assert name == "a?[31m?b\ufffd? \u00e9.csv"
    pn.Insertion(pn.Scene(name, pn.Needle(1e-3, 0.3), pn.Coupling(400, 1), wall))
