"""Starts the system's Chromium without a window and without a graphics card."""

import shutil

from playwright.sync_api import Browser, BrowserContext, Playwright

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


def on_the_bench(context: BrowserContext) -> None:
    """The studio's page opens with all panels, as for a visitor who left it so; else it opens with the stage."""
    context.add_cookies([{"name": "punctura_page", "value": "bench", "domain": "127.0.0.1", "path": "/"}])
