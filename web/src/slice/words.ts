import { mm } from "../format.ts";
import { type Dents, displaced } from "./dents.ts";
import type { Tissue } from "./layers.ts";
import type { NeedleSpan } from "./needle_span.ts";

/** The picture in words. */
export function pictureWords(span: NeedleSpan | null, tissue: Tissue, dents: Dents): string {
  const words = [needleWords(span)];
  if (tissue.vessel) words.push(`The vein is ${mm(lumenHeight(tissue, dents) / 1000, 1)} high at the needle.`);
  if (dents.most > 0.2) words.push(`The needle displaces the tissue by ${mm(dents.most / 1000, 1)}.`);
  return words.join(" ");
}

function needleWords(span: NeedleSpan | null): string {
  if (!span) return "The needle is not in this slice.";
  const { deep, shallow, tip, along } = span;
  const where = `${mm(deep.depth / 1000, 1)} deep`;
  if (tip) return `The needle ${along ? "lies in" : "crosses"} the slice: the tip is ${where}.`;
  if (along) return `The shaft lies in the slice down to ${mm(deep.depth / 1000, 1)}; the tip does not.`;
  return `The shaft crosses the slice ${mm((deep.depth + shallow.depth) / 2000, 1)} deep.`;
}

/** Height of the lumen on the needle's line, mm. */
export function lumenHeight({ vessel }: Tissue, dents: Dents): number {
  if (!vessel) return 0;
  const { depth, radius } = vessel;
  return Math.max(0, displaced(depth + radius, dents) - displaced(depth - radius, dents));
}
