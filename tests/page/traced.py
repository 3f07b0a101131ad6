"""A measured trace for the page: a file that the core makes, and how it is dropped."""

import numpy as np
import punctura as pn
from playwright.sync_api import Locator, Page

# Drops a file into the page, as a browser does.
DROP = """([name, text]) => {
  const data = new DataTransfer();
  data.items.add(new File([text], name));
  for (const kind of ['dragover', 'drop'])
    document.body.dispatchEvent(new DragEvent(kind, {bubbles: true, cancelable: true, dataTransfer: data}));
}"""


def measured() -> str:
    """A trace that the core makes, as CSV: one wall, in and out, with noise; the depth has no unit."""
    depth = np.concatenate([np.arange(0, 15e-3, 50e-6), np.arange(15e-3, 0, -50e-6)])
    wall = pn.ThickLaw(pn.Needle(1.2e-3, 0.4), pn.Membrane(600, 0.3, 0.2, 0.5e-3))
    force = -pn.Proxy1d(wall, pn.Coupling(4000, 1.0), 0.01).run(depth - 5e-3).force
    force = force + 0.01 * np.random.default_rng(1).standard_normal(len(depth))
    rows = zip(0.01 * np.arange(len(depth)), 1e3 * depth, force, strict=True)
    return "\n".join(["time_s,depth,force_N", *(f"{t:.2f},{q:.6g},{f:.6g}" for t, q, f in rows)])


def dropped(page: Page) -> Locator:
    """Drops the trace into the page. The form with the questions about it."""
    page.evaluate(DROP, ["insertion.csv", measured()])
    return page.get_by_role("form", name="What the studio must know of insertion.csv")


def answer(form: Locator) -> None:
    """Fills in what the file does not state."""
    form.get_by_label("Unit of the depth").select_option("mm")
    form.get_by_label("Diameter, mm").fill("1.2")
    form.get_by_label("Tip angle, degrees").fill("22,918")
