// @ts-expect-error: the page itself has no types of Node
import { readFileSync } from "node:fs";
import { describe, expect, it } from "vitest";
import { COLOURS, colourToken } from "../../src/state/colours.ts";

const css: string = readFileSync(new URL("../../src/styles/tokens.css", import.meta.url), "utf8");
type Triple = readonly [number, number, number];
type Matrix = readonly [Triple, Triple, Triple];

const times = (m: Matrix, [x, y, z]: Triple): Triple =>
  m.map(([a, b, c]) => a * x + b * y + c * z) as unknown as Triple;
/** Linear RGB of a token, 0 to 1. */
function linear(token: string, scheme: 0 | 1): Triple {
  const found = new RegExp(`--${token}: light-dark\\((#\\w+), (#\\w+)\\)`).exec(css);
  const hex = found![1 + scheme]!;
  return [1, 3, 5].map((at) => {
    const c = Number.parseInt(hex.slice(at, at + 2), 16) / 255;
    return c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4;
  }) as unknown as Triple;
}
const luminance = ([r, g, b]: Triple): number => 0.2126 * r + 0.7152 * g + 0.0722 * b;
function contrast(one: Triple, other: Triple): number {
  const [dark, light] = [luminance(one), luminance(other)].sort((a, b) => a - b) as [number, number];
  return (light + 0.05) / (dark + 0.05);
}
/** Oklab, in which equal distances look about equally large. */
function oklab(rgb: Triple): Triple {
  const clipped = rgb.map((c) => Math.min(1, Math.max(0, c))) as unknown as Triple;
  const lms = times(
    [
      [0.4122214708, 0.5363325363, 0.0514459929],
      [0.2119034982, 0.6806995451, 0.1073969566],
      [0.0883024619, 0.2817188376, 0.6299787005],
    ],
    clipped,
  ).map(Math.cbrt) as unknown as Triple;
  return times(
    [
      [0.2104542553, 0.793617785, -0.0040720468],
      [1.9779984951, -2.428592205, 0.4505937099],
      [0.0259040371, 0.7827717662, -0.808675766],
    ],
    lms,
  );
}
/** What colour-blind people see: the full strengths of Machado, Oliveira and Fernandes (2009), for linear RGB. */
const SIGHT: Readonly<Record<string, Matrix>> = {
  usual: [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ],
  protanopia: [
    [0.152286, 1.052583, -0.204868],
    [0.114503, 0.786281, 0.099216],
    [-0.003882, -0.048116, 1.051998],
  ],
  deuteranopia: [
    [0.367322, 0.860646, -0.227968],
    [0.280085, 0.672501, 0.047413],
    [-0.01182, 0.04294, 0.968881],
  ],
  tritanopia: [
    [1.255528, -0.076749, -0.178779],
    [-0.078411, 0.930809, 0.147602],
    [0.004733, 0.691367, 0.3039],
  ],
};
const TOKENS = Array.from({ length: COLOURS }, (_, membrane) => colourToken(membrane));

describe.each([
  ["light", 0],
  ["dark", 1],
] as const)("the membranes' colours, %s", (_, scheme) => {
  it.each(["panel", "page"])("can be read as text on the %s", (back) => {
    for (const token of TOKENS) expect(contrast(linear(token, scheme), linear(back, scheme))).toBeGreaterThan(4.5);
  });
  it.each(Object.entries(SIGHT))("differ from each other and from the text: %s", (_, sight) => {
    const seen = [...TOKENS, "text"].map((token) => oklab(times(sight, linear(token, scheme))));
    seen.forEach((one, i) => {
      for (const other of seen.slice(i + 1))
        expect(Math.hypot(...one.map((c, k) => c - other[k]!))).toBeGreaterThan(0.08);
    });
  });
});
