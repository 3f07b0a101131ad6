import { element } from "../../../panel.ts";
import { Figure } from "../../../plots/kit/figure.ts";
import { Hidden, legend } from "../../../plots/kit/legend.ts";
import { CSS_THEME } from "../../../plots/kit/theme.ts";
import { choice } from "../../../plots/toolbar.ts";
import type { FitLine, RivalRow, RivalsLine, TraceLine } from "../../../wire/messages.ts";
import { type Against, drawTrace, type Shown, traceCurves } from "./drawing.ts";

const HEIGHT = 400; // px

/** The plot of a trace, to which its fit and the other models are added. */
export interface TracePlot {
  fit(fit: FitLine): void;
  others(line: RivalsLine): void;
}

export function tracePlot(place: HTMLElement, trace: TraceLine): TracePlot {
  let shown: Shown = { trace, curves: trace.curves, other: null, against: "depth" };
  let rows: readonly RivalRow[] = [];
  const hidden = new Hidden(null);
  const figure = new Figure("lab", HEIGHT, (pen, width, height, theme) => {
    drawTrace(pen, width, height, theme, shown, hidden);
    const pops = trace.pops.length === 1 ? "1 pop" : `${trace.pops.length} pops`;
    const models = [shown.curves.model ? "the model" : "", shown.other?.title ?? ""].filter(Boolean);
    return [`${trace.name}: force against ${shown.against}`, `${trace.samples} samples`, pops, ...models].join(", ");
  });
  const names = legend(hidden);
  hidden.ids.watch(() => figure.redraw());
  const show = (changed: Partial<Shown>): void => {
    shown = { ...shown, ...changed };
    names.show(traceCurves(shown, CSS_THEME));
    figure.redraw();
  };
  const axis = choice(
    "Axis",
    [
      ["depth", "against depth"],
      ["time", "against time"],
    ],
    "depth",
    (value) => show({ against: value as Against }),
  );
  const other = choice("Another model", [["", "no other model"]], "", (value) =>
    show({ other: rows.find(({ name }) => name === value) ?? null }),
  );
  axis.select.hidden = trace.curves.time === null;
  other.select.hidden = true;
  place.replaceChildren(element("div", { class: "plot-bar" }, other.select, axis.select), names.root, figure.root);
  show({});
  return {
    fit: ({ curves }) => show({ curves }),
    others: (line) => {
      rows = line.rows.filter(({ own }) => !own);
      const entries = rows.map(({ name, title }) => [name, `beside ${title}`] as const);
      other.offer([["", "no other model"], ...entries], "");
      other.select.hidden = rows.length === 0;
    },
  };
}
