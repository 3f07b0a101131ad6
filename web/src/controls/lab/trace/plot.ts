import { element } from "../../../panel.ts";
import { Figure } from "../../../plots/kit/figure.ts";
import { Hidden, legend } from "../../../plots/kit/legend.ts";
import { CSS_THEME } from "../../../plots/kit/theme.ts";
import { choice } from "../../../plots/toolbar.ts";
import type { FitLine, TraceLine } from "../../../wire/messages.ts";
import { type Against, drawTrace, traceCurves } from "./drawing.ts";

const HEIGHT = 400; // px

/** The plot of a trace. The returned function adds its fit. */
export function tracePlot(place: HTMLElement, trace: TraceLine): (fit: FitLine) => void {
  let against: Against = "depth";
  let curves = trace.curves;
  const hidden = new Hidden(null);
  const figure = new Figure("lab", HEIGHT, (pen, width, height, theme) => {
    drawTrace(pen, width, height, theme, trace, curves, against, hidden);
    const pops = trace.pops.length === 1 ? "1 pop" : `${trace.pops.length} pops`;
    const what = `${trace.samples} samples, ${pops}`;
    return `${trace.name}: force against ${against}, ${what}${curves.model ? ", and the model" : ""}`;
  });
  const names = legend(hidden);
  hidden.ids.watch(() => figure.redraw());
  const axis = choice(
    "Axis",
    [
      ["depth", "against depth"],
      ["time", "against time"],
    ],
    against,
    (value) => {
      against = value as Against;
      figure.redraw();
    },
  );
  axis.select.hidden = trace.curves.time === null;
  names.show(traceCurves(curves, CSS_THEME));
  place.replaceChildren(element("div", { class: "plot-bar" }, axis.select), names.root, figure.root);
  return (fit) => {
    curves = fit.curves;
    names.show(traceCurves(curves, CSS_THEME));
    figure.redraw();
  };
}
