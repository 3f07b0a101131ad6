import { csv } from "./csv.ts";
import { MARGIN } from "./kit/axes.ts";
import { CanvasPen } from "./kit/canvas_pen.ts";
import { type Curve, drawLegend } from "./kit/legend.ts";
import type { Pen } from "./kit/pen.ts";
import { SvgPen } from "./kit/svg_pen.ts";
import type { Theme } from "./kit/theme.ts";
import type { Plots } from "./shared.ts";

/** The parts of a plot that can be saved. */
export interface Saving {
  readonly name: string;
  readonly plots: Plots;
  theme(): Theme;
  /** The membrane that is shown, or null for all. */
  membranes(): number | null;
  size(): readonly [width: number, height: number];
  draw(pen: Pen): void;
  /** The curves for the legend below the picture. */
  curves(): readonly Curve[];
}

const PNG_RATIO = 2; // pixels of the file per pixel of the plot: sharp enough for print

/** Makes the browser download a file. */
export function download(name: string, parts: BlobPart[], type: string): void {
  const url = URL.createObjectURL(new Blob(parts, { type }));
  const link = document.createElement("a");
  link.href = url;
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}

export async function save(saving: Saving, format: "png" | "svg" | "csv"): Promise<void> {
  const { plots } = saving;
  if (plots.noDepth) return; // the menu is hidden then; each format has depths
  const { source, window } = plots;
  const scene = source.scene.value;
  const [width, upper] = saving.size();
  const span = `${window.from.toFixed(3)} s to ${window.to.toFixed(3)} s`;
  const title = `${scene?.name ?? "Punctura"}, ${span}`;
  const file = `${saving.name}-${window.from.toFixed(2)}s.${format}`;
  if (format === "csv") {
    download(file, csv(source.history, window.first, window.end, saving.membranes()), "text/csv");
    return;
  }
  const theme = saving.theme();
  const legend = (pen: Pen): number => drawLegend(pen, MARGIN.left, width, upper, saving.curves(), theme);
  const height = upper + legend(new SvgPen());
  if (format === "svg") {
    const pen = new SvgPen();
    saving.draw(pen);
    legend(pen);
    const words = `${scene?.membranes.length ?? 0} membranes, solver ${scene?.solver ?? "unknown"}`;
    download(file, [pen.file(width, height, theme.panel, title, words)], "image/svg+xml");
    return;
  }
  const canvas = document.createElement("canvas");
  canvas.width = width * PNG_RATIO;
  canvas.height = height * PNG_RATIO;
  const pen = new CanvasPen(canvas.getContext("2d")!);
  pen.begin(width, height, PNG_RATIO);
  pen.box(0, 0, width, height, theme.panel, 1);
  saving.draw(pen);
  legend(pen);
  const blob = await new Promise<Blob | null>((done) => canvas.toBlob(done, "image/png"));
  if (blob) download(file, [blob], "image/png");
}
