"""The studio as a person meets it: `punctura run` in a process of its own, its page in Chromium."""

import os
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))  # for person.py
sys.path.insert(0, str(Path(__file__).parents[2] / "tools"))

from chromium import launch
from person import PATIENCE, opened
from playwright.sync_api import Browser, Page, expect, sync_playwright
from studio_process import StudioProcess
from warm import warm

expect.set_options(timeout=PATIENCE)
os.environ["PUNCTURA_LAB_NICE"] = "0"  # other tests run at the same time; a computation must not wait for them


@pytest.fixture(scope="session", autouse=True)
def _program(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    with warm(tmp_path_factory.mktemp("warm"), "seldom") as StudioProcess.program:
        yield


@pytest.fixture
def studio(tmp_path: Path) -> Iterator[StudioProcess]:
    with StudioProcess(tmp_path, "k06-fig10") as running:
        yield running


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    with sync_playwright() as playwright:
        launched = launch(playwright)
        yield launched
        launched.close()


@pytest.fixture
def page(browser: Browser, studio: StudioProcess) -> Iterator[Page]:
    """The studio's page. The question about sound was answered before."""
    with opened(browser, studio.url) as page:
        yield page
