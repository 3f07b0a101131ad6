"""Starts the system's Chromium without a window and without a graphics card."""

from __future__ import annotations

import shutil

from playwright.sync_api import Browser, Playwright

# Without a graphics card, Chromium renders in software. Only WebGL must be enabled explicitly.
FLAGS = [
    "--no-sandbox", "--disable-quic", "--no-first-run", "--disable-background-networking",
    "--disable-component-update", "--disable-sync", "--enable-unsafe-swiftshader",
]  # fmt: skip


def launch(playwright: Playwright) -> Browser:
    # Debian's headless shell first: the page's tests need half the time in it.
    names = ("chromium-headless-shell", "chromium", "chromium-browser", "google-chrome")
    found = next(filter(None, map(shutil.which, names)), None)
    assert found, "Chromium is missing: apt-get install chromium-headless-shell (or chromium)"
    return playwright.chromium.launch(executable_path=found, args=FLAGS)
