import { element, keepChildren } from "../../panel.ts";
import { keep, storage } from "../../state/remembered.ts";
import { Signal } from "../../state/signal.ts";
import { textWidth } from "./labels.ts";
import type { Pen } from "./pen.ts";
import type { Theme } from "./theme.ts";

const SIZE = 11.5; // px
const SAMPLE = 16; // px, length of an entry's line
const EDGE = 3; // px

/** A curve of a plot: its name and its look. */
export interface Curve {
  /** Plots that have the same curve show or hide it together. */
  readonly id: string;
  readonly text: string;
  readonly colour: string;
  /** px; default 2.5 */
  readonly width?: number;
  readonly dash?: readonly number[];
  /** Opacity of a shade; without it the curve is a line. */
  readonly shade?: number;
}

/** The curves that the user has switched off. With a name, they stay off when the page is opened again. */
export class Hidden {
  readonly ids: Signal<ReadonlySet<string>>;

  /** name: key in the browser's storage; null stores nothing. off: curves that are off until they are switched on. */
  constructor(
    private readonly name: string | null,
    off: readonly string[] = [],
  ) {
    this.ids = new Signal<ReadonlySet<string>>(new Set(this.stored() ?? off));
  }

  shows(id: string): boolean {
    return !this.ids.value.has(id);
  }

  toggle(id: string): void {
    const ids = new Set(this.ids.value);
    if (!ids.delete(id)) ids.add(id);
    this.ids.value = ids;
    if (this.name !== null) keep(this.name, JSON.stringify([...ids]));
  }

  private stored(): string[] | null {
    if (this.name === null) return null;
    try {
      const ids: unknown = JSON.parse(storage()?.getItem(this.name) ?? "null");
      return Array.isArray(ids) ? ids.map(String) : null;
    } catch {
      return null;
    }
  }
}

/** A row of buttons, one for each curve, that show and hide the curves. */
export function legend(hidden: Hidden): { readonly root: HTMLElement; show(curves: readonly Curve[]): void } {
  const root = element("div", { class: "plot-legend", role: "group", "aria-label": "Curves" });
  let shown = "";
  let entries = new Map<string, Entry>();
  const mark = (): void => {
    for (const [id, { button }] of entries) button.setAttribute("aria-pressed", String(hidden.shows(id)));
  };
  hidden.ids.watch(mark);
  return {
    root,
    show: (curves) => {
      const now = JSON.stringify(curves);
      if (now === shown) return;
      shown = now;
      const before = entries;
      entries = new Map(curves.map(({ id }) => [id, before.get(id) ?? new Entry(() => hidden.toggle(id))]));
      for (const curve of curves) entries.get(curve.id)!.show(curve);
      keepChildren(
        root,
        [...entries.values()].map(({ button }) => button),
      );
      mark();
    },
  };
}

/** A curve's button. It stays while the curve's text changes, as the scale of a force does. */
class Entry {
  readonly button: HTMLButtonElement;
  private readonly sample = element("i", { "aria-hidden": "true" });
  private readonly words = document.createTextNode("");

  constructor(act: () => void) {
    this.button = element("button", { type: "button", onclick: act }, this.sample, this.words);
  }

  show({ text, colour, width, dash, shade }: Curve): void {
    const { sample } = this;
    sample.className = shade !== undefined ? "shade" : dash ? "dashed" : "line";
    sample.style.setProperty("--ink", colour);
    sample.style.setProperty("--line-width", width ? `${width}px` : "");
    this.words.data = text;
  }
}

/** Draws a shade with a dense upper edge, which stays visible if the shade is narrow or lines cover it. */
export function drawShade(
  pen: Pen,
  x: number,
  y: number,
  width: number,
  height: number,
  colour: string,
  alpha: number,
): void {
  pen.box(x, y, width, height, colour, alpha);
  pen.box(x, y, width, EDGE, colour, 0.9);
}

/** Draws the legend of a saved picture: the entries from `left` on, in rows below y. Returns the height, px. */
export function drawLegend(
  pen: Pen,
  left: number,
  right: number,
  y: number,
  curves: readonly Curve[],
  theme: Theme,
): number {
  let x = left;
  let row = y + 10;
  for (const { text, colour, shade, dash, width = 2.5 } of curves) {
    const wide = SAMPLE + 5 + textWidth(text, SIZE);
    if (x > left && x + wide > right) {
      x = left;
      row += 16;
    }
    if (shade === undefined) pen.segment(x, row, x + SAMPLE, row, { colour, width, ...(dash && { dash }) });
    else drawShade(pen, x, row - 5, SAMPLE, 10, colour, shade);
    pen.text(x + SAMPLE + 5, row, text, { colour: theme.text, size: SIZE });
    x += wide + 12;
  }
  return curves.length ? row + 10 - y : 0;
}
