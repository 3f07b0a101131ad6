"""The files that `punctura reproduce` writes."""

import re

import pytest
from PIL import Image
from punctura.reproduce import Reproduction, palette

pytestmark = pytest.mark.xdist_group("reproduction")  # in one worker: what they share takes seconds to make


FIGURES = ("fig03", "fig05", "fig10", "fig11", "fig12", "chatter", "pop")


@pytest.fixture(scope="session")
def page(made: Reproduction) -> str:
    return made.page.read_text(encoding="utf-8")


@pytest.mark.parametrize("name", FIGURES)
def test_every_figure_comes_as_png_for_print_as_svg_and_as_numbers(made: Reproduction, name: str) -> None:
    with Image.open(made.folder / f"{name}.png") as picture:
        assert picture.size[0] == 2100
        assert picture.info["dpi"] == pytest.approx((300, 300), abs=0.1)
        assert len(picture.convert("RGB").getcolors(1 << 24)) > 100
    svg = (made.folder / f"{name}.svg").read_text(encoding="utf-8")
    assert svg.rstrip().endswith("</svg>")
    assert "<text" not in svg, "letters are outlines, so that no font is needed"
    assert (made.folder / f"{name}.csv").stat().st_size > 500


def test_the_files_named_are_the_files_there(made: Reproduction) -> None:
    assert sorted(made.files) == sorted(file.name for file in made.folder.iterdir())
    assert made.files[0] == "index.html"


def test_every_column_names_its_unit(made: Reproduction) -> None:
    units = re.compile(r"_(mm|N|s|ms)( \(|$)")
    for file in made.folder.glob("*.csv"):
        header = file.read_text(encoding="utf-8").split("\n", 1)[0].split(",")
        plain = {"line", "stage", "in_close_up", "turns_exact", "turns_paper"}  # words and counts
        assert all(name in plain or units.search(name) for name in header), header


def test_the_page_points_only_to_files_beside_it_and_to_itself(made: Reproduction, page: str) -> None:
    targets = re.findall(r'\b(?:href|src|srcset|data|action)="([^"]*)"', page) + re.findall(r"url\(([^)]*)\)", page)
    ids = re.findall(r'\bid="([^"]*)"', page)
    assert len(ids) == len(set(ids)), "no id twice"
    for target in targets:
        assert target[1:] in ids if target.startswith("#") else (made.folder / target).is_file(), target
    assert {f"{name}.{kind}" for name in FIGURES for kind in ("png", "svg", "csv")} <= set(targets)


def test_the_page_loads_nothing_from_a_network_and_runs_nothing(page: str) -> None:
    names = {"http://www.w3.org/2000/svg", "http://www.w3.org/1999/xlink"}  # of the picture format, never loaded
    assert set(re.findall(r"https?://[^\"' )<]+", page)) <= names
    assert not re.search(r"<script|<link|<iframe|@import|@font-face|\son\w+=", page)


def test_every_colour_of_every_picture_has_a_dark_twin(page: str) -> None:
    pictures = re.findall(r"<svg.*?</svg>", page, flags=re.DOTALL)
    assert len(pictures) == len(FIGURES)
    assert not [colour for picture in pictures for colour in re.findall(r"#[0-9a-f]{6}\b", picture)]
    assert len({c.light for c in palette.ALL}) == len({c.name for c in palette.ALL}) == len(palette.ALL)


def test_the_page_shows_measured_beside_expected_numbers_parameters_and_versions(made: Reproduction, page: str) -> None:
    assert "0.4102 N" in page and "0.57 N/mm" in page and "1600 Hz" in page
    for m in made.measured:
        assert f"{m.measured:.4f}" in page or not m.unit
    assert re.search(r"punctura \d+\.\d+", page) and "matplotlib" in page and "numpy" in page
