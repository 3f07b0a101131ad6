"""What the tests of the package and of the page share: the option of test_page.py, and Chromium."""

import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, sync_playwright

sys.path.insert(0, str(Path(__file__).parents[2] / "tools"))

from chromium import launch


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--page", help="the folder of the page without a server")


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    with sync_playwright() as playwright:
        launched = launch(playwright)
        yield launched
        launched.close()
