/** Parses and prints typed numbers, with a decimal point or a decimal comma. */

export type Parsed = { readonly value: number } | { readonly wrong: string };

const NUMBER = /^[+-]?(\d+([.,]\d*)?|[.,]\d+)(e[+-]?\d+)?$/i;

/** The number in a text, or a sentence that tells what is wrong with it. */
export function parseNumber(text: string, whole = false): Parsed {
  const trimmed = text.trim().replace("−", "-");
  if (trimmed === "") return { wrong: "Enter a number." };
  if (/\d[.,]\d*[.,]/.test(trimmed)) {
    return { wrong: `“${trimmed}” has more than one point or comma. Write 1600 without a separator.` };
  }
  if (!NUMBER.test(trimmed)) {
    const unit = trimmed.match(/^([+-]?[\d.,]+)\s*[a-zµ°/]+/i);
    if (unit) return { wrong: `Enter only the number, ${unit[1]}, without a unit.` };
    return { wrong: `“${trimmed}” is not a number. Write it as 0.5 or 0,5.` };
  }
  const value = Number(trimmed.replace(",", "."));
  if (!Number.isFinite(value)) return { wrong: `“${trimmed}” is too large.` };
  if (whole && !Number.isInteger(value)) return { wrong: "Enter a whole number." };
  return { value };
}

/** The shortest text of the number, with at most 12 digits. */
export function numberText(value: unknown): string {
  if (typeof value !== "number") return value === undefined ? "" : String(value);
  const short = Number(value.toPrecision(12));
  return String(short);
}

/** The number rounded to `digits` significant digits. */
export const rounded = (value: number, digits = 3): number => Number(value.toPrecision(digits));

/** The number one step up or down for the arrow keys: one unit of its second digit. */
export function nudged(value: number, direction: 1 | -1): number {
  if (value === 0) return direction * 0.01;
  const exponent = Math.floor(Math.log10(Math.abs(value)));
  const down = direction * Math.sign(value) < 0;
  const lowest = Math.abs(value) <= 10 ** exponent * (1 + 1e-12); // 1.0 goes down to 0.99
  const step = 10 ** (exponent - (down && lowest ? 2 : 1));
  return rounded(value + direction * step, 12);
}
