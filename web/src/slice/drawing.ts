import { MM, type Moment } from "../scene/moment.ts";
import { type ProbePlace, planeOf, type SkinFrame } from "../scene/probe.ts";
import type { SceneView } from "../wire/messages.ts";
import { Denter, type Dents } from "./dents.ts";
import { pictureDepth, type Tissue, tissueOf } from "./layers.ts";
import { drawNeedle } from "./needle_echo.ts";
import { type NeedleSpan, needleSpan } from "./needle_span.ts";
import { paintTissue, shadowOf } from "./picture.ts";
import { type Frame, frameOf, RULER_PX, rasterOf, rulerMarks } from "./raster.ts";

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
