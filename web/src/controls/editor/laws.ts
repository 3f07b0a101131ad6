import { element } from "../../panel.ts";
import { Figure } from "../../plots/kit/figure.ts";
import type { LawCurve } from "../../wire/messages.ts";
import { svg } from "../svg.ts";
import { LawShape } from "./law_shape.ts";

const HEIGHT = 166; // px

export interface LawDrawing {
  readonly root: HTMLElement;
  /** before: the law before the last change, drawn as a thin line behind. */
  show(law: LawCurve | null, before: LawCurve | null): void;
  /** Marks the tip's depth in this membrane, m, and its force, N; null outside. */
  mark(depth: number | null, force: number): void;
}

/** Draws a membrane's friction band on the hand: insertion friction -Phi_I above, withdrawal friction -Phi_O below. */
export function lawDrawing(): LawDrawing {
  const shape = new LawShape();
  let law: LawCurve | null = null;
  let before: LawCurve | null = null;
  const figure = new Figure("laws", HEIGHT, (pen, width, height, theme) => {
    if (!law) return "no law yet";
    shape.draw(pen, law, before, width, height, theme);
    const [most, least] = [-Math.min(...law.lower), -Math.max(...law.upper)];
    return (
      `Friction band of ${law.name}: at most ${most.toFixed(2)} N going in, ` +
      `${least.toFixed(2)} N coming out; through at ${(law.through * 1e3).toFixed(2)} mm.`
    );
  });
  const tip = svg("circle", { class: "tip", r: 4, visibility: "hidden" });

  return {
    root: element("figure", { class: "law-drawing" }, figure.root),
    show: (now, old) => {
      if (now?.name !== law?.name) shape.forget();
      [law, before] = [now, old];
      if (law) shape.fit(law, performance.now() / 1e3);
      figure.redraw();
      figure.root.firstElementChild?.append(tip);
    },
    mark: (depth, force) => {
      const { pane } = shape;
      const inside = depth !== null && depth >= 0 && depth * 1e3 <= pane.x.max;
      tip.setAttribute("visibility", inside ? "inherit" : "hidden");
      if (!inside) return;
      if (!tip.isConnected) figure.root.firstElementChild?.append(tip);
      tip.setAttribute("cx", pane.x.px(depth * 1e3).toFixed(1));
      tip.setAttribute("cy", Math.min(Math.max(pane.y.px(-force), pane.top), pane.bottom).toFixed(1));
    },
  };
}
