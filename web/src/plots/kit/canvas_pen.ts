import { FONT, type Lettering, type Pen, type Stroke } from "./pen.ts";
import type { Polyline } from "./polyline.ts";

const SOLID: number[] = [];
// Without a GPU, a long line that crosses itself is slower to draw than the same line in pieces: 14 ms instead of
// 4 ms for 2000 points of chatter.
const CHUNK = 32;

/** Draws on a canvas with `ratio` device pixels per CSS pixel. */
export class CanvasPen implements Pen {
  constructor(private readonly context: CanvasRenderingContext2D) {}

  begin(width: number, height: number, ratio: number): void {
    this.context.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.context.clearRect(0, 0, width, height);
    this.context.lineJoin = "bevel"; // a mitre would draw a spike beyond its value
  }

  /** Draws another canvas of the same ratio at the top left. */
  picture(canvas: HTMLCanvasElement, width: number, height: number): void {
    this.context.drawImage(canvas, 0, 0, width, height);
  }

  /** Moves the canvas' picture to the left by whole device pixels. */
  scroll(canvas: HTMLCanvasElement, pixels: number): void {
    const c = this.context;
    c.save();
    c.setTransform(1, 0, 0, 1, 0, 0);
    c.globalCompositeOperation = "copy";
    c.drawImage(canvas, -pixels, 0);
    c.restore();
  }

  /** Clears a box. */
  clear(x: number, y: number, width: number, height: number): void {
    this.context.clearRect(x, y, width, height);
  }

  line({ xs, ys, count }: Polyline, stroke: Stroke): void {
    const c = this.context;
    this.style(stroke);
    const phase = stroke.dash ? (stroke.phase ?? 0) : Number.NaN;
    const begin = (x: number, y: number): void => {
      if (!Number.isNaN(phase)) {
        c.stroke();
        c.beginPath();
        c.lineDashOffset = x + phase; // the dashes depend on the place alone, not on where a piece begins
      }
      c.moveTo(x, y);
    };
    c.beginPath();
    let down = false;
    let drawn = 0;
    for (let i = 0; i < count; i++) {
      const x = xs[i]!;
      const y = ys[i]!;
      if (Number.isNaN(y)) down = false;
      else if (!down) {
        begin(x, y);
        if (i + 1 === count || Number.isNaN(ys[i + 1])) c.lineTo(x + 1, y); // makes a single point visible
        down = true;
      } else {
        c.lineTo(x, y);
        if (++drawn < CHUNK) continue;
        c.stroke();
        c.beginPath();
        begin(x, y);
        drawn = 0;
      }
    }
    c.stroke();
    c.globalAlpha = 1;
    c.lineDashOffset = 0;
  }

  area({ xs, ys, count }: Polyline, colour: string, alpha: number): void {
    const c = this.context;
    c.beginPath();
    for (let i = 0; i < count; i++) c.lineTo(xs[i]!, ys[i]!);
    c.globalAlpha = alpha;
    c.fillStyle = colour;
    c.fill();
    c.globalAlpha = 1;
  }

  segment(x1: number, y1: number, x2: number, y2: number, stroke: Stroke): void {
    this.context.beginPath();
    this.context.moveTo(x1, y1);
    this.context.lineTo(x2, y2);
    this.stroke(stroke);
  }

  box(x: number, y: number, width: number, height: number, colour: string, alpha: number): void {
    this.context.globalAlpha = alpha;
    this.context.fillStyle = colour;
    this.context.fillRect(x, y, width, height);
    this.context.globalAlpha = 1;
  }

  dot(x: number, y: number, radius: number, fill: string, rim: string): void {
    this.context.beginPath();
    this.context.arc(x, y, radius, 0, 2 * Math.PI);
    this.context.fillStyle = fill;
    this.context.fill();
    this.stroke({ colour: rim, width: 1.5 });
  }

  text(x: number, y: number, text: string, { colour, size = 11, anchor = "start", bold, halo }: Lettering): void {
    const c = this.context;
    c.font = `${bold ? "600 " : ""}${size}px ${FONT}`;
    c.textBaseline = "middle";
    c.textAlign = anchor === "middle" ? "center" : anchor;
    if (halo) {
      c.strokeStyle = halo;
      c.lineWidth = 3;
      c.setLineDash(SOLID);
      c.strokeText(text, x, y);
    }
    c.fillStyle = colour;
    c.fillText(text, x, y);
  }

  within(x: number, y: number, width: number, height: number, draw: () => void): void {
    this.context.save();
    this.context.beginPath();
    this.context.rect(x, y, width, height);
    this.context.clip();
    draw();
    this.context.restore();
  }

  private stroke(stroke: Stroke): void {
    this.style(stroke);
    this.context.stroke();
    this.context.globalAlpha = 1;
  }

  private style({ colour, width, alpha = 1, dash }: Stroke): void {
    const c = this.context;
    c.strokeStyle = colour;
    c.lineWidth = width;
    c.globalAlpha = alpha;
    c.setLineDash((dash as number[] | undefined) ?? SOLID);
  }
}
