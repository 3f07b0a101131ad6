"""The option of test_page.py."""

import pytest


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--page", help="the folder of the page without a server")
