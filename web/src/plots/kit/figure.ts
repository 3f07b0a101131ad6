import { element } from "../../panel.ts";
import type { Pen } from "./pen.ts";
import { SvgPen } from "./svg_pen.ts";
import { CSS_THEME, type Theme } from "./theme.ts";

/** Draws into a box of this size, px. Returns what a screen reader says of the drawing. */
export type Draw = (pen: Pen, width: number, height: number, theme: Theme) => string;

/** A drawing that fills the width of its place, as SVG. Its letters keep their size at every width. */
export class Figure {
  readonly root: HTMLElement;
  private width = 0;

  constructor(
    kind: string,
    readonly height: number,
    private readonly draw: Draw,
  ) {
    this.root = element("div", { class: `figure ${kind}` });
    this.root.style.minHeight = `${height}px`;
    new ResizeObserver(([entry]) => {
      const width = Math.round(entry!.contentRect.width);
      if (width === this.width) return;
      this.width = width;
      this.redraw();
    }).observe(this.root);
  }

  redraw(): void {
    if (this.width < 40) return;
    const pen = new SvgPen();
    const words = this.draw(pen, this.width, this.height, CSS_THEME);
    const file = pen.file(this.width, this.height, "none", words, "");
    const svg = new DOMParser().parseFromString(file, "image/svg+xml").documentElement;
    this.root.replaceChildren(document.importNode(svg, true));
  }
}
