"""The studio as a person meets it: `punctura run` in a process of its own, its page in Chromium."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))  # for person.py
sys.path.insert(0, str(Path(__file__).parents[2] / "tools"))

from chromium import launch
from playwright.sync_api import Browser, Page, sync_playwright
from studio_process import StudioProcess


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
    """The studio's page, past its tour; every error of its script fails the test."""
    errors: list[str] = []
    # Half the resolution: the processor draws a quarter of the pixels, and nobody looks.
    size = {"width": 1440, "height": 900}
    context = browser.new_context(viewport=size, device_scale_factor=0.5, reduced_motion="reduce")
    # The question about sound was answered before.
    context.add_cookies([{"name": "punctura_sound", "value": "off", "url": studio.url}])
    opened = context.new_page()
    opened.on("pageerror", lambda error: errors.append(str(error)))
    opened.goto(studio.url, timeout=120_000)
    yield opened
    context.close()
    assert not errors, errors
