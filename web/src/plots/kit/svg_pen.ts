import { FONT, type Lettering, type Pen, type Stroke } from "./pen.ts";
import type { Polyline } from "./polyline.ts";

/** Draws into the text of an SVG file. */
export class SvgPen implements Pen {
  private readonly parts: string[] = [];
  private static clips = 0; // a page may show several drawings: their names must differ

  /** The file's text. Screen readers read `title` and `words`. */
  file(width: number, height: number, back: string, title: string, words: string): string {
    const size = `width="${width}" height="${height}" viewBox="0 0 ${width} ${height}"`;
    return [
      `<svg xmlns="http://www.w3.org/2000/svg" ${size} role="img">`,
      `<title>${escaped(title)}</title>${words && `<desc>${escaped(words)}</desc>`}`,
      ...(back === "none" ? [] : [`<rect width="100%" height="100%" fill="${back}"/>`]),
      ...this.parts,
      "</svg>\n",
    ].join("\n");
  }

  line(points: Polyline, stroke: Stroke): void {
    const path = pathOf(points);
    if (path) this.parts.push(`<path d="${path}" fill="none" ${strokeOf(stroke)}/>`);
  }

  area(points: Polyline, colour: string, alpha: number): void {
    const path = pathOf(points);
    if (path) this.parts.push(`<path d="${path}Z" fill="${colour}" fill-opacity="${alpha}"/>`);
  }

  segment(x1: number, y1: number, x2: number, y2: number, stroke: Stroke): void {
    this.parts.push(`<path d="M${px(x1)} ${px(y1)}L${px(x2)} ${px(y2)}" ${strokeOf(stroke)}/>`);
  }

  box(x: number, y: number, width: number, height: number, colour: string, alpha: number): void {
    const size = `x="${px(x)}" y="${px(y)}" width="${px(width)}" height="${px(height)}"`;
    this.parts.push(`<rect ${size} fill="${colour}" fill-opacity="${alpha}"/>`);
  }

  dot(x: number, y: number, radius: number, fill: string, rim: string): void {
    const at = `cx="${px(x)}" cy="${px(y)}" r="${radius}"`;
    this.parts.push(`<circle ${at} fill="${fill}" stroke="${rim}" stroke-width="1.5"/>`);
  }

  text(x: number, y: number, text: string, { colour, size = 11, anchor = "start", bold, halo }: Lettering): void {
    const rim = halo ? ` stroke="${halo}" stroke-width="3" paint-order="stroke"` : "";
    const font = `font-family='${FONT}' font-size="${size}"${bold ? ' font-weight="600"' : ""}`;
    const at = `x="${px(x)}" y="${px(y)}" text-anchor="${anchor}" dominant-baseline="central"`;
    this.parts.push(`<text ${at} ${font} fill="${colour}"${rim}>${escaped(text)}</text>`);
  }

  within(x: number, y: number, width: number, height: number, draw: () => void): void {
    const id = `clip${SvgPen.clips++}`;
    const box = `<rect x="${px(x)}" y="${px(y)}" width="${px(width)}" height="${px(height)}"/>`;
    this.parts.push(`<clipPath id="${id}">${box}</clipPath><g clip-path="url(#${id})">`);
    draw();
    this.parts.push("</g>");
  }
}

const px = (value: number): string => String(Math.round(value * 100) / 100);

const escaped = (text: string): string =>
  text.replace(/[&<>"]/g, (c) => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" })[c]!);

function strokeOf({ colour, width, alpha = 1, dash }: Stroke): string {
  const faint = alpha < 1 ? ` stroke-opacity="${Math.round(alpha * 1000) / 1000}"` : "";
  const gaps = dash?.length ? ` stroke-dasharray="${dash.join(" ")}"` : "";
  return `stroke="${colour}" stroke-width="${width}" stroke-linejoin="bevel"${faint}${gaps}`;
}

function pathOf({ xs, ys, count }: Polyline): string {
  let path = "";
  let down = false;
  for (let i = 0; i < count; i++) {
    const gap = Number.isNaN(ys[i]);
    if (!gap) path += `${down ? "L" : "M"}${px(xs[i]!)} ${px(ys[i]!)}`;
    const lone = !gap && !down && (i + 1 === count || Number.isNaN(ys[i + 1]));
    if (lone) path += "h1";
    down = !gap;
  }
  return path;
}
