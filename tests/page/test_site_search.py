"""The site's search shows where it found the words, also if the site is opened as a file."""

from pathlib import Path

from sphinx.cmd.build import main as sphinx

SITE = Path(__file__).parents[2] / "docs" / "site"
CONFIGURATION = f"""
import sys
sys.path.insert(0, {str(SITE)!r})
extensions, html_theme = ["search_texts"], "furo"
"""


def test_the_search_of_a_site_that_was_opened_as_a_file_shows_summaries(tmp_path, browser):
    (tmp_path / "conf.py").write_text(CONFIGURATION)
    (tmp_path / "index.rst").write_text("Needles\n=======\n\n.. toctree::\n\n   other/page\n")
    (tmp_path / "other").mkdir()
    (tmp_path / "other/page.rst").write_text("Walls\n=====\n\nA membrane & its peritoneum gives <way>.\n")
    assert sphinx(["-q", "-W", str(tmp_path), str(tmp_path / "html")]) == 0
    page = browser.new_page()
    try:
        page.goto((tmp_path / "html/search.html").as_uri() + "?q=peritoneum")
        summary = page.locator("#search-results .context")
        summary.wait_for()
        assert "A membrane & its peritoneum gives <way>." in summary.inner_text()
    finally:
        page.close()
