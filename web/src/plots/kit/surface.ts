import { element } from "../../panel.ts";
import { CanvasPen } from "./canvas_pen.ts";

export interface Box {
  readonly x1: number;
  readonly y1: number;
  readonly x2: number;
  readonly y2: number;
}

const DRAG = 6; // px: a press that moves this far is a drag

/** A canvas that fills its host. The pointer points at a place or draws a box. Lengths are CSS pixels. */
export class Surface {
  readonly canvas: HTMLCanvasElement;
  private readonly pen: CanvasPen;
  width = 0;
  height = 0;
  /** The pointer's position; null while it is outside. */
  pointer: { readonly x: number; readonly y: number } | null = null;
  /** The box that the person is drawing. */
  box: Box | null = null;
  /** Counts the changes that need a new drawing. */
  changes = 0;
  /** Counts the changes of size. */
  sizes = 0;
  /** Device pixels per CSS pixel. */
  ratio = 1;
  private scale = 1; // of the drawing: --scale of the style sheet, for a projector
  private readonly back = document.createElement("canvas");
  private readonly backPen: CanvasPen;
  private readonly lines = document.createElement("canvas");
  private readonly linesPen: CanvasPen;

  constructor(
    host: HTMLElement,
    label: string,
    private readonly handlers: {
      boxDrawn(box: Box): void;
      doubleClicked(): void;
      /** Returns whether the key has a meaning here. */
      key(event: KeyboardEvent): boolean;
    },
    /** Whether it has a layer of lines. */
    private readonly lined = false,
  ) {
    this.canvas = element("canvas", { class: "plot-canvas", tabindex: 0, role: "application", "aria-label": label });
    host.append(this.canvas);
    this.pen = new CanvasPen(this.canvas.getContext("2d")!);
    this.backPen = new CanvasPen(this.back.getContext("2d")!);
    this.linesPen = new CanvasPen(this.lines.getContext("2d")!);
    new ResizeObserver(() => this.fit(host)).observe(host);
    window.addEventListener("resize", () => this.fit(host)); // the page's zoom changes only the ratio
    this.fit(host);
    this.listen();
  }

  /** Clears the background, which is redrawn rarely. */
  beginBack(): CanvasPen {
    this.backPen.begin(this.width, this.height, this.ratio);
    return this.backPen;
  }

  /** Clears the layer of lines, which lies on the background. */
  beginLines(): CanvasPen {
    this.linesPen.begin(this.width, this.height, this.ratio);
    return this.linesPen;
  }

  /**
   * Moves the layer of lines to the left by whole device pixels, clears what has come to the left of `start`, px, and
   * calls `draw`, which draws the part from `from` on again.
   */
  scrollLines(pixels: number, start: number, from: number, draw: (pen: CanvasPen) => void): void {
    const pen = this.linesPen;
    if (pixels > 0) pen.scroll(this.lines, pixels);
    pen.clear(0, 0, start, this.height);
    const left = Math.floor(from * this.ratio) / this.ratio; // a box on whole device pixels has no soft edge
    pen.clear(left, 0, this.width - left, this.height);
    pen.within(left, 0, this.width - left, this.height, () => draw(pen));
  }

  /** Copies background and lines to the screen; the caller draws the foreground on top. */
  begin(): CanvasPen {
    this.pen.begin(this.width, this.height, this.ratio);
    this.pen.picture(this.back, this.width, this.height);
    if (this.lined) this.pen.picture(this.lines, this.width, this.height);
    return this.pen;
  }

  private fit(host: HTMLElement): void {
    const { clientWidth, clientHeight } = host;
    this.scale = Number(getComputedStyle(host).getPropertyValue("--scale")) || 1;
    this.width = clientWidth / this.scale;
    this.height = clientHeight / this.scale;
    this.ratio = devicePixelRatio * this.scale;
    for (const canvas of [this.canvas, this.back, ...(this.lined ? [this.lines] : [])]) {
      canvas.width = Math.max(1, Math.round(clientWidth * devicePixelRatio));
      canvas.height = Math.max(1, Math.round(clientHeight * devicePixelRatio));
    }
    this.sizes++;
  }

  private listen(): void {
    const { canvas } = this;
    const at = (event: PointerEvent): { x: number; y: number } => ({
      x: event.offsetX / this.scale,
      y: event.offsetY / this.scale,
    });
    const leave = (): void => {
      this.pointer = null;
      this.changes++;
    };
    let pressed: { x: number; y: number } | null = null;
    canvas.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      canvas.setPointerCapture(event.pointerId);
      pressed = at(event);
      this.pointer = pressed;
      this.changes++;
    });
    document.addEventListener("pointerdown", (event) => {
      if (event.target !== canvas && this.pointer) leave();
    });
    canvas.addEventListener("pointermove", (event) => {
      this.pointer = at(event);
      this.changes++;
      if (!pressed) return;
      const { x, y } = this.pointer;
      const far = Math.hypot(x - pressed.x, y - pressed.y) >= DRAG;
      if (this.box || far) this.box = { x1: pressed.x, y1: pressed.y, x2: x, y2: y };
    });
    const release = (accept: boolean): void => {
      const { box } = this;
      pressed = null;
      this.box = null;
      this.changes++;
      if (accept && box) this.handlers.boxDrawn(box);
    };
    canvas.addEventListener("pointerup", () => release(true));
    canvas.addEventListener("pointercancel", () => release(false));
    canvas.addEventListener("pointerleave", (event) => {
      if (event.pointerType !== "touch") leave(); // a touch keeps its point after the finger is lifted
    });
    canvas.addEventListener("dblclick", () => this.handlers.doubleClicked());
    canvas.addEventListener("keydown", (event) => {
      if (event.altKey || event.ctrlKey || event.metaKey) return;
      if (this.handlers.key(event)) event.preventDefault();
      this.changes++;
    });
  }
}
