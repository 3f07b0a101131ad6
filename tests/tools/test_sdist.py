"""The sdist holds every file of the tree and the studio's page, and nothing that a build leaves.

tools/release.sh builds a wheel from it.
"""

from __future__ import annotations

import subprocess
import sys
import tarfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BUILD = "import sys; from scikit_build_core.build import build_sdist; build_sdist(sys.argv[1])"
PAGE = "python/punctura/studio/page/"  # git ignores it; ./test builds it before the tests
BUILT = ("build/", "out/", ".venv/", ".git/", "web/node_modules/")


def test_an_sdist_is_the_tree_with_the_page(tmp_path: Path) -> None:
    subprocess.run([sys.executable, "-c", BUILD, str(tmp_path)], cwd=ROOT, check=True, capture_output=True)
    (archive,) = tmp_path.glob("punctura-*.tar.gz")
    with tarfile.open(archive) as opened:
        packed = {name.partition("/")[2] for name in opened.getnames()}
    listed = subprocess.run(["git", "ls-files"], cwd=ROOT, check=True, capture_output=True, text=True).stdout
    tree = {file for file in listed.splitlines() if (ROOT / file).exists()}
    assert tree - packed == set()
    assert PAGE + "index.html" in packed
    assert [name for name in packed if name.startswith(BUILT) or "__pycache__" in name] == []
