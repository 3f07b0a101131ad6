"""Record, replay, export."""

import numpy as np
import pyarrow.parquet as parquet
from person import drag_in, events, ready, saved, tab, whole_at
from playwright.sync_api import expect
from punctura.record import replay


def test_a_run_is_recorded_replayed_and_exported(page, tmp_path):
    ready(page)
    tab(page, "Recordings")
    page.get_by_role("textbox", name="Name of the recording").fill("first try")
    page.get_by_role("button", name="Record", exact=True).click()
    expect(page.locator(".record-line")).to_contain_text("0 lost")
    expect(page.locator(".header")).to_contain_text("Force on")
    drag_in(page, pops=1)
    drop = events(page, "pop").first.inner_text()
    stop = page.get_by_role("button", name="Stop", exact=True)
    for size in ((1440, 900), (1024, 768)):
        whole_at(page, size, stop)
    page.set_viewport_size({"width": 390, "height": 844})
    stop.scroll_into_view_if_needed()  # on a phone the page is one column
    whole_at(page, (390, 844), stop)
    page.set_viewport_size({"width": 1440, "height": 900})
    page.get_by_role("button", name="Stop", exact=True).click()
    name = page.get_by_role("textbox", name="Name of the recording")
    name.fill("second try")  # while the first one is being finished

    entry = page.locator(".recording", has_text="first try")
    file = saved(page, entry.get_by_role("button", name="parquet"), tmp_path)
    ticks = parquet.read_table(file).column("tick").to_numpy()
    assert (np.diff(ticks) == 1).all()
    expect(name).to_have_value("second try")
    again = replay(file)
    assert again.identical and again.complete

    entry.get_by_role("button", name="Replay", exact=True).click()
    bar = page.get_by_role("group", name="Replay")
    expect(bar).to_be_visible()
    expect(page.locator("body")).to_contain_text("Replay of")
    bar.get_by_role("button", name="Next event").click()
    assert events(page, "pop").first.inner_text().split("s", 1)[1] == drop.split("s", 1)[1]
    page.get_by_role("button", name="Back to live").first.click()
    expect(page.get_by_role("group", name="Replay")).to_have_count(0)
