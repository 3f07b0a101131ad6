"""The checks of the built site find errors, and the C++ reference is complete."""

import re
from pathlib import Path

import check
import cpp_reference
import field_words
import gallery
import pages
import pytest
import studio_style
import text
import wordless

ROOT = Path(__file__).resolve().parents[2]
REFERENCE = dict(cpp_reference.pages())
TOKENS = (ROOT / "web/src/styles/tokens.css").read_text(encoding="utf-8")
INTERNAL = re.compile(r"namespace (?:punctura::)?detail \{.*?\}  // namespace (?:punctura::)?detail", re.S)
PAGE = '<html><body id="top">{}</body></html>'


def test_the_page_of_the_studios_style_shows_every_name_of_the_style_sheet_once():
    page = studio_style.page()
    names = re.findall(r"^ *--([\w-]+):", TOKENS, re.M)
    assert len(names) > 20
    for name in names:
        assert page.count(f"`--{name}`") == 1, f"{name}: give it its use as a comment behind it"
    for colour in re.findall(r"#[0-9a-f]{6}", TOKENS):
        assert f"background:{colour}" in page
    assert "font-size:clamp(40px, 11vmin, 132px)" in page


def test_the_index_of_the_python_reference_has_the_first_words_of_each_package():
    index = dict(pages.python_pages())["index.rst"]
    assert "- :doc:`punctura.events`: Events at the membranes: touch, pop and exit of the tip.\n" in index
    assert all(re.search(rf"^- :doc:`{name}`: \w", index, re.M) for name in pages.PACKAGES)


def site(folder: Path, **pages: str) -> list[str]:
    for name, body in pages.items():
        suffix = "css" if name == "style" else "html"
        (folder / f"{name}.{suffix}").write_text(body if suffix == "css" else PAGE.format(body))
    return check.findings(folder)


@pytest.mark.parametrize(
    "body",
    [
        '<script src="https://cdn.example.org/x.js"></script>',
        '<link rel="stylesheet" href="//fonts.example.org/css">',
        '<img src="http://example.org/a.png">',
        '<p style="background: url(https://example.org/a.png)">',
    ],
)
def test_a_page_that_fetches_something_from_another_host_is_found(tmp_path, body):
    assert "from another host" in site(tmp_path, index=body)[0]


def test_a_style_sheet_that_fetches_a_font_from_another_host_is_found(tmp_path):
    assert "from another host" in site(tmp_path, style="@font-face { src: url('https://example.org/f.woff2') }")[0]


def test_a_link_to_another_host_is_allowed_because_the_reader_decides(tmp_path):
    assert site(tmp_path, index='<a href="https://example.org">there</a>') == []


@pytest.mark.parametrize("link", ["missing.html", "#missing", "other.html#missing"])
def test_a_link_inside_the_site_that_leads_nowhere_is_found(tmp_path, link):
    assert f"links to {link}" in site(tmp_path, index=f'<a href="{link}">x</a>', other="")[0]


def test_a_link_inside_the_site_that_leads_somewhere_is_in_order(tmp_path):
    assert site(tmp_path, index='<a href="other.html#top">x</a><a href="#top">y</a>', other="") == []


CLASS = """<dl class="py class"><dt id="p.A"><span>A</span></dt><dd><p>{}</p>
<dl class="py attribute"><dt id="p.A.x">x: int</dt><dd><p>{}</p></dd></dl></dd></dl>"""


@pytest.mark.parametrize(
    ("of_class", "of_field", "found"),
    [("Doc.", "", 1), ("Doc.", "m", 0), ("x: m", "", 0), ("xy", "", 1), ("", "m", 1)],
)
def test_a_member_of_the_reference_without_words_is_found(tmp_path, of_class, of_field, found):
    page = tmp_path / "reference/python/p.html"
    page.parent.mkdir(parents=True)
    page.write_text(CLASS.format(of_class, of_field))
    assert len(list(wordless.findings(tmp_path))) == found


def test_the_words_of_a_field_are_the_comment_beside_it_or_above_it():
    fields = "    a: int = f(\n        1,  # no\n    )  # a\n    # b\n    b: str\n"
    source = f"class A:\n{fields}\n    def c(self):\n        d: int = 1  # no\n"
    assert field_words.comments(source) == {"a": "a", "b": "b"}


def names(entries) -> set[str]:
    found = set()
    for entry in entries:
        found |= {entry.text, *names(entry.members)}
    return found


@pytest.mark.parametrize("header", cpp_reference.headers())
def test_the_reference_has_every_class_function_and_comment_of_a_header(header):
    source = INTERNAL.sub("", (ROOT / header).read_text())
    page = "\n".join(names(cpp_reference.entries(cpp_reference.parse(source))))
    shown = REFERENCE[f"{cpp_reference.room(header)}.rst"]
    outer = re.findall(r"^(?:class|struct|enum class|concept) (\w+)(?! *;)(?:<.*>)?[^;]*\{", source, re.M)
    functions = re.findall(r"^(?:inline |constexpr |template <[^>]*> )*[\w:<>]+[&*]? (\w+)\(", source, re.M)
    for name in [*outer, *functions]:
        assert re.search(rf"\b{name}\b", page), name
    for comment in re.findall(r"^///(?!<) ?(.{12,})$", source, re.M):
        assert text.escape_rst(comment).strip() in shown


def test_a_private_member_is_not_in_the_reference():
    source = "/// Doc.\nclass A {\n public:\n  int shown();  ///< yes\n\n private:\n  int hidden_;\n};\n"
    [a] = cpp_reference.entries(cpp_reference.parse(source))
    assert a == cpp_reference.Entry("class", "A", "Doc.", (cpp_reference.Entry("function", "int shown()", "yes"),))


def test_every_declaration_is_one_that_sphinx_can_link_to_but_for_one_constant():
    def plain(entries):
        for entry in entries:
            if not cpp_reference.sphinx_reads(entry):
                yield entry.text
            yield from plain(entry.members)

    found = [
        t
        for h in cpp_reference.headers()
        for t in plain(cpp_reference.entries(cpp_reference.parse((ROOT / h).read_text())))
    ]
    assert [t for t in found if "memory_is_whole" not in t] == []


def test_plain_text_stays_plain_text_in_the_site():
    assert text.escape_rst("f* = |x_| and `code_`") == r"f\* = \|x\_\| and ``code_``"
    assert text.docstring_rst(["Do:", "", "    a *= 2", "", "then b*"]) == [
        "Do:",
        "",
        "::",
        "",
        "    a *= 2",
        "",
        r"then b\*",
    ]


def test_every_example_has_a_picture():
    """The gallery runs what it draws, so it runs each example in Python; ./test examples runs those in C++."""
    stems = {path.stem for path in gallery.EXAMPLES.glob("*/*") if path.suffix in (".py", ".cpp")}
    assert stems == set(gallery.PICTURES)
