import { mm } from "../format.ts";
import type { Dents } from "./dents.ts";
import type { Tissue } from "./layers.ts";
import type { NeedleSpan } from "./needle_span.ts";

/** The picture in words. rowHeight: of the dents' rows, mm. */
export function pictureWords(span: NeedleSpan | null, tissue: Tissue, dents: Dents, rowHeight: number): string {
  const words = [needleWords(span)];
  const { vein } = tissue;
  if (vein) words.push(`The vein is ${mm(veinHeight(tissue, dents, rowHeight) / 1000, 1)} high at the needle.`);
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

/** Height of the lumen on the needle's line, mm: its front moves with the dent, its back moves less. */
export function veinHeight({ vein }: Tissue, dents: Dents, rowHeight: number): number {
  if (!vein) return 0;
  const shifted = (place: number): number => {
    // The displaced place of an undeformed one: the row whose displacement leads back to it.
    const rows = dents.rows.length / 3;
    for (let row = 0; row < rows; row++) {
      const depth = (row + 0.5) * rowHeight;
      if (depth - dents.rows[3 * row + 2]! >= place) return depth;
    }
    return place;
  };
  return Math.max(0, shifted(vein.depth + vein.radius) - shifted(vein.depth - vein.radius));
}
