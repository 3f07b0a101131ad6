import { button, element } from "../../panel.ts";
import { Figure } from "../../plots/kit/figure.ts";
import { Hidden, legend } from "../../plots/kit/legend.ts";
import { CSS_THEME } from "../../plots/kit/theme.ts";
import { choice } from "../../plots/toolbar.ts";
import type { App } from "../../state/app.ts";
import type { LabComparison } from "../../wire/messages.ts";
import { saveAddress } from "../download.ts";
import { drawLab, labCurves, type On, QUANTITIES, type Quantity, quantitiesOf } from "./drawing.ts";
import { bundlePath, type Job } from "./job.ts";
import { labTable } from "./table.ts";

const HEIGHT = 380; // px

/** The dialog of a comparison: its curves, its numbers, and one button that saves everything. */
export function openComparison(app: App, job: Job, title: string, comparison: LabComparison): void {
  let on: On = "depth";
  let quantity: Quantity = "model";
  const hidden = new Hidden(null);
  const figure = new Figure("lab", HEIGHT, (pen, width, height, theme) => {
    drawLab(pen, width, height, theme, comparison, on, quantity, hidden);
    return `${title}: ${QUANTITIES[quantity]} against ${on}`;
  });
  const curves = legend(hidden);
  curves.show(labCurves(comparison, CSS_THEME));
  const stop = hidden.ids.watch(() => figure.redraw());
  const against = choice(
    "Axis",
    [
      ["depth", "against depth"],
      ["time", "against time"],
    ],
    on,
    (value) => {
      on = value as On;
      figure.redraw();
    },
  );
  const force = choice("Quantity", quantitiesOf(comparison), quantity, (value) => {
    quantity = value as Quantity;
    figure.redraw();
  });
  const inPlots = button("Show in the plots", "Draw mean and standard deviation in the page's plots", () => {
    app.comparison.value = app.comparison.value === comparison ? null : comparison;
  });
  const unwatch = app.comparison.watch((shown) => {
    inPlots.setAttribute("aria-pressed", String(shown === comparison));
    inPlots.textContent = shown === comparison ? "Remove from the plots" : "Show in the plots";
  });
  const save = button("Save everything (zip)", "Figure as SVG and PDF, data as CSV and Parquet, scenes, citation", () =>
    saveAddress(app.api.address(bundlePath(job, on)), "punctura-comparison.zip"),
  );
  const dialog = element(
    "dialog",
    { class: "result tab lab-result", "aria-labelledby": "lab-title" },
    element("header", {}, element("h2", { id: "lab-title" }, title)),
    element("div", { class: "plot-bar" }, force.select, against.select),
    curves.root,
    figure.root,
    labTable(comparison),
    element(
      "p",
      { class: "quiet" },
      "Small numbers: the difference to the first run. Overshoot: how far the bevel ran on in the 0.3 s after a pop. " +
        "Against depth, a curve has the values at the moment when the tip first came to each depth. " +
        "The mean is that of the runs that come so far, two or more.",
    ),
    element(
      "footer",
      { class: "tools" },
      save,
      inPlots,
      element("span", { class: "gap" }),
      button("Close", "Close", () => dialog.close(), "small primary"),
    ),
  );
  dialog.addEventListener("close", () => {
    stop();
    unwatch();
    dialog.remove();
  });
  document.body.append(dialog);
  dialog.showModal();
}
