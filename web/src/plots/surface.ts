import { element } from "../panel.ts";
import { CanvasPen } from "./canvas_pen.ts";

export interface Box {
  readonly x1: number;
  readonly y1: number;
  readonly x2: number;
  readonly y2: number;
}

const DRAG = 6; // px from which on a press is a drag

/** A canvas that fills its host, with a pointer that can point at a place or draw a box. CSS pixels. */
export class Surface {
  readonly canvas: HTMLCanvasElement;
  private readonly pen: CanvasPen;
  width = 0;
  height = 0;
  /** Where the pointer is; null while it is elsewhere. */
  pointer: { readonly x: number; readonly y: number } | null = null;
  /** The box that is being drawn. */
  box: Box | null = null;
  /** Counts what happened here that asks for another drawing. */
  changes = 0;
  /** Counts the sizes that this has had. */
  sizes = 0;
  private ratio = 1;
  private readonly back = document.createElement("canvas");
  private readonly backPen: CanvasPen;

  constructor(
    host: HTMLElement,
    label: string,
    private readonly acts: {
      boxed(box: Box): void;
      doubled(): void;
      /** Whether the key was one. */
      key(event: KeyboardEvent): boolean;
    },
  ) {
    this.canvas = element("canvas", { class: "plot-canvas", tabindex: 0, role: "application", "aria-label": label });
    host.append(this.canvas);
    this.pen = new CanvasPen(this.canvas.getContext("2d")!);
    this.backPen = new CanvasPen(this.back.getContext("2d")!);
    new ResizeObserver(() => this.fit(host)).observe(host);
    window.addEventListener("resize", () => this.fit(host)); // a zoom of the page changes only the ratio
    this.fit(host);
    this.listen();
  }

  /** Clears the background, which is drawn seldom. */
  beginBack(): CanvasPen {
    this.backPen.begin(this.width, this.height, this.ratio);
    return this.backPen;
  }

  /** Shows the background, for the foreground to be drawn on it. */
  begin(): CanvasPen {
    this.pen.begin(this.width, this.height, this.ratio);
    this.pen.picture(this.back, this.width, this.height);
    return this.pen;
  }

  private fit(host: HTMLElement): void {
    const { clientWidth, clientHeight } = host;
    this.width = clientWidth;
    this.height = clientHeight;
    this.ratio = devicePixelRatio;
    for (const canvas of [this.canvas, this.back]) {
      canvas.width = Math.max(1, Math.round(clientWidth * this.ratio));
      canvas.height = Math.max(1, Math.round(clientHeight * this.ratio));
    }
    this.sizes++;
  }

  private listen(): void {
    const { canvas } = this;
    const at = (event: PointerEvent): { x: number; y: number } => ({ x: event.offsetX, y: event.offsetY });
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
    const letGo = (take: boolean): void => {
      const { box } = this;
      pressed = null;
      this.box = null;
      this.changes++;
      if (take && box) this.acts.boxed(box);
    };
    canvas.addEventListener("pointerup", () => letGo(true));
    canvas.addEventListener("pointercancel", () => letGo(false));
    canvas.addEventListener("pointerleave", (event) => {
      if (event.pointerType !== "touch") leave(); // what a finger points at is read when the finger is gone
    });
    canvas.addEventListener("dblclick", () => this.acts.doubled());
    canvas.addEventListener("keydown", (event) => {
      if (event.altKey || event.ctrlKey || event.metaKey) return;
      if (this.acts.key(event)) event.preventDefault();
      this.changes++;
    });
  }
}
