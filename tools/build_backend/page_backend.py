"""Extends the build back-end of scikit-build-core (PEP 517, 660).

It reports a missing compiler with its remedy, and builds the studio's page before packaging.
"""

import os
import sys
from pathlib import Path

import native_tools
import studio_page
from scikit_build_core import build as native

prepare_metadata_for_build_wheel = getattr(native, "prepare_metadata_for_build_wheel", None)
prepare_metadata_for_build_editable = getattr(native, "prepare_metadata_for_build_editable", None)
Settings = dict[str, "list[str] | str"] | None


def get_requires_for_build_wheel(settings: Settings = None) -> list[str]:
    return [*native.get_requires_for_build_wheel(settings), *studio_page.requirements()]


def get_requires_for_build_editable(settings: Settings = None) -> list[str]:
    return [*native.get_requires_for_build_editable(settings), *studio_page.requirements()]


def get_requires_for_build_sdist(settings: Settings = None) -> list[str]:
    return [*native.get_requires_for_build_sdist(settings), *studio_page.requirements()]


def build_wheel(directory: str, settings: Settings = None, metadata: str | None = None) -> str:
    _compiler()
    _page()
    return native.build_wheel(directory, settings, metadata)


def build_editable(directory: str, settings: Settings = None, metadata: str | None = None) -> str:
    _compiler()
    _page()
    return native.build_editable(directory, settings, metadata)


def build_sdist(directory: str, settings: Settings = None) -> str:
    _page()  # included, so that a wheel can be built from the sdist without Node
    return native.build_sdist(directory, settings)


def _compiler() -> None:
    try:
        native_tools.check()
    except native_tools.ToolsError as error:
        _give_up(error)


def _page() -> None:
    try:
        # ./test keeps node_modules for its next build. ./run and a plain pip install leave none.
        studio_page.build(Path.cwd(), keep_modules="PUNCTURA_KEEP_NODE_MODULES" in os.environ)
    except studio_page.PageError as error:
        _give_up(error)


def _give_up(error: Exception) -> None:
    sys.stdout.flush()
    print(f"\n*** {error}", file=sys.stderr)
    raise SystemExit(1) from None
