import { MM, type Moment } from "../scene/moment.ts";
import { type ProbePlace, planeOf, type SkinFrame } from "../scene/probe.ts";
import type { SceneView } from "../wire/messages.ts";
import { Denter, type Dents } from "./dents.ts";
import { pictureDepth, type Tissue, tissueOf } from "./layers.ts";
import { drawNeedle, type ToPixels } from "./needle_echo.ts";
import { type NeedleSpan, needleSpan } from "./needle_span.ts";
import { paintTissue, type Raster, shadowOf } from "./picture.ts";

const WIDEST_MM = 50; // of a linear probe
const RULER_PX = 30;

/** Where the picture lies on the canvas: CSS pixels, and mm. */
export interface Frame extends ToPixels {
  readonly left: number;
  readonly top: number;
  readonly across: number;
  readonly down: number;
  readonly width: number;
  readonly depth: number;
}

/** The picture's frame on a canvas of this size, with a ruler to its right. depth: mm. */
export function frameOf(canvasWidth: number, canvasHeight: number, depth: number): Frame {
  const scale = Math.max(1, canvasHeight) / depth;
  const width = Math.min(WIDEST_MM, Math.max(1, canvasWidth - RULER_PX) / scale);
  const across = width * scale;
  const left = Math.max(0, (canvasWidth - RULER_PX - across) / 2);
  return {
    scale, left, top: 0, across, down: canvasHeight, width, depth,
    x: (along) => left + (along + width / 2) * scale,
    y: (below) => below * scale,
  }; // biome-ignore format: short
}

/** The tissue's raster in a frame, with about so many pixels and not more than the screen has. */
export function rasterOf({ across, down, width, depth }: Frame, pixels: number): Raster {
  const part = Math.min(1, Math.sqrt(pixels / (across * down)));
  return {
    columns: Math.max(8, Math.round(across * part)),
    rows: Math.max(8, Math.round(down * part)),
    width,
    depth,
  };
}

/** Places of the ruler's marks, mm: about eight, at round numbers. */
export function rulerMarks(depth: number): number[] {
  const step = depth > 40 ? 10 : depth > 16 ? 5 : 2;
  return Array.from({ length: Math.floor(depth / step) + 1 }, (_, i) => i * step).filter((at) => at < depth);
}

const SHAFT_MM = 150; // longer than any picture

/** What a picture shows, for its words. */
export interface Shown {
  readonly span: NeedleSpan | null;
  readonly dents: Dents;
  readonly tissue: Tissue;
  readonly frame: Frame;
}

/** Draws slices of one scene on a canvas. */
export class Drawing {
  readonly tissue: Tissue;
  readonly depth: number;
  private readonly denter: Denter;
  private readonly small = document.createElement("canvas");
  private image: ImageData | null = null;
  private shadow = new Float32Array(0);

  constructor(
    private readonly scene: SceneView,
    private readonly skin: SkinFrame,
  ) {
    this.tissue = tissueOf(scene, skin);
    this.depth = pictureDepth(this.tissue);
    this.denter = new Denter(skin, this.tissue, this.depth, scene.diameter * MM);
  }

  /** width, height: CSS pixels; pixels: of the tissue's raster. */
  draw(
    canvas: HTMLCanvasElement,
    width: number,
    height: number,
    moment: Moment,
    place: ProbePlace,
    pixels: number,
  ): Shown | null {
    const draw = canvas.getContext("2d");
    if (!draw) return null;
    const frame = frameOf(width, height, this.depth);
    const raster = rasterOf(frame, pixels);
    const plane = planeOf(this.skin, place);
    const diameter = this.scene.diameter * MM;
    const span = needleSpan(plane, moment.tip, moment.axis, SHAFT_MM, diameter / 2);
    const dents = this.denter.at(moment);
    const image = this.sized(raster.columns, raster.rows);
    shadowOf(span, diameter / 2, raster, this.shadow);
    const grey = new Uint32Array(image.data.buffer);
    paintTissue(grey, raster, plane, this.skin, this.tissue, dents, this.shadow);
    this.small.getContext("2d")?.putImageData(image, 0, 0);
    const ratio = canvas.width / Math.max(1, width);
    draw.setTransform(ratio, 0, 0, ratio, 0, 0);
    draw.fillStyle = "#000";
    draw.fillRect(0, 0, width, height);
    draw.imageSmoothingEnabled = true;
    draw.drawImage(this.small, frame.left, frame.top, frame.across, frame.down);
    if (span) {
      draw.save();
      draw.beginPath();
      draw.rect(frame.left, frame.top, frame.across, frame.down);
      draw.clip();
      const facing = Math.sqrt(Math.max(0, 1 - moment.axis.dot(plane.inward) ** 2));
      drawNeedle(draw, span, frame, diameter, facing);
      draw.restore();
    }
    ruler(draw, frame, width);
    return { span, dents, tissue: this.tissue, frame };
  }

  private sized(columns: number, rows: number): ImageData {
    if (!this.image || this.image.width !== columns || this.image.height !== rows) {
      this.image = new ImageData(columns, rows);
      this.small.width = columns;
      this.small.height = rows;
      this.shadow = new Float32Array(columns);
    }
    return this.image;
  }
}

function ruler(draw: CanvasRenderingContext2D, frame: Frame, width: number): void {
  const x = width - RULER_PX;
  draw.fillStyle = "#c8ccd2";
  draw.font = "11px system-ui, sans-serif";
  draw.textBaseline = "middle";
  for (const mark of rulerMarks(frame.depth)) {
    const y = Math.max(6, frame.y(mark));
    draw.fillRect(x + 2, frame.y(mark), 5, 1);
    draw.fillText(mark === 0 ? "mm" : String(mark), x + 9, y);
  }
}
