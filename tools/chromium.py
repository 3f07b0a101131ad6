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
    found = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
    assert found, "Chromium is missing: apt-get install chromium"
    return playwright.chromium.launch(executable_path=found, args=FLAGS)
