"""Builds the site: prepares the pages, generates the reference and the gallery, runs Sphinx, checks the result.

    docs/build                          into build/docs/html
    python docs/site/build.py --quick   to check it: no page is marked in its own sidebar, as conf.py says

Any warning of Sphinx is an error: a broken link, a notebook that fails, a docstring that cannot be read.
"""

import shutil
import sys
from pathlib import Path

import check
import cpp_reference
import gallery
import pages
import studio_style
import wordless
from layout import ROOT, SITE, lay_out
from sphinx.cmd.build import main as sphinx

OUT = ROOT / "build" / "docs"


def write(path: Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")


def main(quick: bool) -> int:
    source, html = OUT / "source", OUT / "html"
    shutil.rmtree(html, ignore_errors=True)
    lay_out(source)
    for name, text in pages.python_pages():
        write(source / "reference" / "python" / name, text)
    for name, text in cpp_reference.pages():
        write(source / "reference" / "cpp" / name, text)
    write(source / "reference" / "command-line.md", pages.command_line_page())
    write(source / "reference" / "scene-keys.md", pages.scene_keys_page())
    write(source / "reference" / "studio-style.md", studio_style.page())
    gallery.write(source / "gallery")
    how = ["-q", "-W", "--keep-going", "-E", *(["-t", "quick"] if quick else ["-j", "2"])]
    code = sphinx([*how, "-c", str(SITE), "-d", str(OUT / "doctrees"), str(source), str(html)])
    findings = [*check.findings(html), *wordless.findings(html)]
    for finding in findings:
        print(finding)
    if code or findings:
        return 1
    print(f"{sum(1 for _ in html.rglob('*.html'))} pages: {html / 'index.html'}")
    return 0


if __name__ == "__main__":
    sys.exit(main("--quick" in sys.argv[1:]))
