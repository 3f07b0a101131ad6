import { element } from "../../panel.ts";
import type { LawCurve } from "../../wire/messages.ts";
import { svg } from "../svg.ts";
import { bandPath, curvePath, type Extent, extentFor, type Place, placing, ticksOf } from "./law_shape.ts";

const WIDTH = 330;
const HEIGHT = 152;
const LEFT = 44;
const TOP = 20;
const PLOT_WIDTH = WIDTH - LEFT - 10;
const PLOT_HEIGHT = HEIGHT - TOP - 30;

export interface LawDrawing {
  readonly root: HTMLElement;
  /** before: the law before the last change, drawn as a thin line behind. */
  show(law: LawCurve | null, before: LawCurve | null): void;
  /** Marks the tip's depth in this membrane, m, and its force, N; null outside. */
  mark(depth: number | null, force: number): void;
}

/** A law with the signs that the hand feels, the opposite of the needle's: resistance to insertion is positive. */
export const felt = (law: LawCurve): LawCurve => ({
  ...law,
  upper: law.lower.map((force) => -force),
  lower: law.upper.map((force) => -force),
});

/** Draws a membrane's friction band on the hand: insertion friction -Phi_I above, withdrawal friction -Phi_O below. */
export function lawDrawing(): LawDrawing {
  const grid = svg("g", { class: "grid" });
  const band = svg("path", { class: "band" });
  const old = svg("path", { class: "before" });
  const upper = svg("path", { class: "upper" });
  const lower = svg("path", { class: "lower" });
  const tip = svg("circle", { class: "tip", r: 4, visibility: "hidden" });
  const words = svg("title", {}, "no law yet");
  const drawing = svg(
    "svg",
    { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: "img", class: "laws" },
    words,
    grid,
    band,
    old,
    lower,
    upper,
    svg("text", { class: "name upper", x: LEFT, y: 11 }, "Φ", sub("I"), " going in"),
    svg("text", { class: "name lower", x: WIDTH - 10, y: 11, "text-anchor": "end" }, "Φ", sub("O"), " coming out"),
    tip,
  );
  let extent: Extent | null = null;
  let place: Place = () => [0, 0];
  let name = "";

  const drawGrid = (now: Extent): void => {
    const lines: SVGElement[] = [];
    const [x0, y0] = place(0, 0);
    for (const depth of ticksOf(0, now.depth)) {
      const [x] = place(depth, 0);
      lines.push(svg("line", { x1: x, x2: x, y1: TOP, y2: TOP + PLOT_HEIGHT }));
      lines.push(svg("text", { x, y: TOP + PLOT_HEIGHT + 13, "text-anchor": "middle" }, numberOf(depth * 1e3)));
    }
    for (const force of ticksOf(now.least, now.most)) {
      const [, y] = place(0, force);
      lines.push(svg("line", { x1: x0, x2: x0 + PLOT_WIDTH, y1: y, y2: y }));
      lines.push(svg("text", { x: x0 - 5, y: y + 3.5, "text-anchor": "end" }, numberOf(force)));
    }
    lines.push(svg("line", { class: "zero", x1: x0, x2: x0 + PLOT_WIDTH, y1: y0, y2: y0 }));
    lines.push(svg("text", { x: LEFT + PLOT_WIDTH / 2, y: HEIGHT - 3, "text-anchor": "middle" }, "depth, mm"));
    const [side, middle] = [9, TOP + PLOT_HEIGHT / 2];
    lines.push(
      svg(
        "text",
        { x: side, y: middle, "text-anchor": "middle", transform: `rotate(-90 ${side} ${middle})` },
        "on the hand, N",
      ),
    );
    grid.replaceChildren(...lines);
  };

  return {
    root: element("figure", { class: "law-drawing" }, drawing),
    show: (model, before) => {
      drawing.classList.toggle("empty", model === null);
      if (!model) return;
      const law = felt(model);
      const next = extentFor(law, law.name === name ? extent : null);
      name = law.name;
      if (!extent || next.depth !== extent.depth || next.least !== extent.least || next.most !== extent.most) {
        extent = next;
        place = placing(next, LEFT, TOP, PLOT_WIDTH, PLOT_HEIGHT);
        drawGrid(next);
      }
      band.setAttribute("d", bandPath(law, place, extent.depth));
      upper.setAttribute("d", curvePath(law.depth, law.upper, place, extent.depth));
      lower.setAttribute("d", curvePath(law.depth, law.lower, place, extent.depth));
      old.setAttribute("d", before ? outline(felt(before), place, extent.depth) : "");
      words.textContent =
        `Friction band of ${law.name}: at most ${Math.max(...law.upper).toFixed(2)} N going in, ` +
        `${Math.min(...law.lower).toFixed(2)} N coming out; through at ${(law.through * 1e3).toFixed(2)} mm.`;
    },
    mark: (depth, force) => {
      const inside = depth !== null && extent !== null && depth >= 0 && depth <= extent.depth;
      tip.setAttribute("visibility", inside ? "visible" : "hidden");
      if (!inside) return;
      const [x, y] = place(depth, -force);
      tip.setAttribute("cx", x.toFixed(1));
      tip.setAttribute("cy", Math.min(Math.max(y, TOP), TOP + PLOT_HEIGHT).toFixed(1));
    },
  };
}

const sub = (text: string): SVGTSpanElement => svg("tspan", { "baseline-shift": "sub", "font-size": "70%" }, text);
const numberOf = (value: number): string => String(Number(value.toPrecision(4))).replace("-", "−");
const outline = (law: LawCurve, place: Place, end: number): string =>
  curvePath(law.depth, law.upper, place, end) + curvePath(law.depth, law.lower, place, end);
