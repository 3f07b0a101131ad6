import type { EstimatePart, FitLine, RivalsLine } from "../../../wire/messages.ts";

/** Name, unit of display, and the size of one SI unit in it. */
type Quantity = readonly [words: string, unit: string, gain: number];

// The names are those of the scene editor.
const QUANTITIES: Readonly<Record<string, Quantity>> = {
  surface: ["depth of the surface", "mm", 1e3],
  stiffness: ["stiffness", "N/mm", 1e-3],
  precompression: ["precompression", "N", 1],
  friction: ["friction", "", 1],
  thickness: ["thickness", "mm", 1e3],
  tip_length: ["tip length", "mm", 1e3],
  growth: ["growth of the grip", "1/mm", 1e-3],
  tail_length: ["tail length", "mm", 1e3],
  tail_floor: ["tail floor", "", 1],
  cutting: ["cutting force", "N", 1],
  set: ["set", "", 1],
  coupling_stiffness: ["spring between needle and tissue", "N/mm", 1e-3],
  coupling_damping: ["damping between needle and tissue", "N s/m", 1],
  relaxation_1_stiffness: ["spring that relaxes", "N/mm", 1e-3],
  relaxation_1_time: ["time of its relaxation", "s", 1],
  relaxation_2_stiffness: ["second spring that relaxes", "N/mm", 1e-3],
  relaxation_2_time: ["time of its relaxation", "s", 1],
  offset: ["zero of the force sensor", "mN", 1e3],
  drift: ["drift of the force sensor", "mN/s", 1e3],
  lag: ["lag of the force sensor", "ms", 1e3],
  delay: ["delay of the force", "ms", 1e3],
};
const NAME = /\b(?:(membrane\[(\d+)\]|tissue)\.)?([a-z][a-z0-9_]*)\b/;
const OF_PARAMETER = /^(membrane\[\d+\]|tissue)\.[a-z_0-9]+|^[a-z]+(_[a-z0-9]+)+|^(offset|drift|lag|delay)\b/;

const minus = (text: string): string => text.replace(/-/g, "−");

/** "Membrane 1: stiffness" of "membrane[0].stiffness". Unknown names stay as they are. */
export function parameterWords(name: string): string {
  const [, owner, number, kind] = NAME.exec(name) ?? [];
  const words = kind && QUANTITIES[kind]?.[0];
  if (!words) return name;
  if (!owner) return words.charAt(0).toUpperCase() + words.slice(1);
  return `${number === undefined ? "All membranes" : `Membrane ${Number(number) + 1}`}: ${words}`;
}

/** A number with so many digits after the point that its interval is told with two digits. */
function digitsOf(low: number | null, high: number | null, value: number): number {
  const width = low === null || high === null ? Math.abs(value) / 100 : (high - low) / 2;
  if (!(width > 0)) return 3;
  return Math.min(6, Math.max(0, 1 - Math.floor(Math.log10(width))));
}

/** The value with its unit, its interval in the same unit, and half the interval as a part of the value, in percent. */
export function estimateWords(estimate: EstimatePart): { value: string; interval: string; relative: string } {
  const kind = estimate.name.split(".").at(-1)!;
  const [, unit, gain] = QUANTITIES[kind] ?? [kind, estimate.unit === "-" ? "" : estimate.unit, 1];
  const scaled = (one: number | null): number | null => (one === null ? null : one * gain);
  const [value, low, high] = [estimate.value * gain, scaled(estimate.low), scaled(estimate.high)];
  const digits = digitsOf(low, high, value);
  const text = (one: number): string => minus(one.toFixed(digits));
  const behind = unit && ` ${unit}`;
  const interval =
    low !== null && high !== null
      ? `${text(low)} to ${text(high)}`
      : low !== null
        ? `more than ${text(low)}`
        : high !== null
          ? `less than ${text(high)}`
          : "any value";
  const known = low !== null && high !== null && value !== 0 && !["offset", "drift", "surface"].includes(kind);
  const share = known ? (50 * (high - low)) / Math.abs(value) : null;
  const relative = share === null ? "" : `± ${share < 9.95 ? share.toPrecision(2) : share.toFixed(0)} %`;
  return { value: `${text(value)}${behind}`, interval, relative };
}

/** A sentence about a parameter, with the parameter's words for its name. */
export const doubtWords = (text: string): string => {
  const [name] = OF_PARAMETER.exec(text) ?? [""];
  const words = name ? parameterWords(name) + text.slice(name.length) : text;
  return words.charAt(0).toUpperCase() + words.slice(1);
};

/** A text of a program for the command line, without its hints for the command line. */
export const withoutOptions = (text: string): string => text.replace(/ \(--[^)]*\)/g, "");

const percent = (share: number): string => `${(100 * share).toPrecision(2)} %`;
const newtons = (force: number): string =>
  force < 0.1 ? `${(1e3 * force).toPrecision(2)} mN` : `${force.toFixed(2)} N`;

/** How well the model explains the trace, in one sentence. */
export function fitWords(fit: Pick<FitLine, "membranes" | "extensions" | "rmse" | "rmse_share" | "explained">): string {
  const more = fit.extensions.length ? `${fit.extensions.join(", ")} and ` : "";
  const walls = fit.membranes === 1 ? "one membrane" : `${fit.membranes} membranes`;
  const error = `${newtons(fit.rmse)} rms, ${percent(fit.rmse_share)} of its peak`;
  const but = fit.explained ? "" : ", but does not explain the trace: see below";
  return `K06 with ${more}${walls} follows the force to ${error}${but}.`;
}

/** Whether another model fits better, in one sentence. */
export function rankWords({ rows }: Pick<RivalsLine, "rows">): string {
  const own = rows.filter(({ own }) => own).sort((a, b) => (a.aic ?? Infinity) - (b.aic ?? Infinity))[0];
  const others = rows.filter((row) => !row.own && row.aic !== null);
  const best = others.sort((a, b) => a.aic! - b.aic!)[0];
  if (!own || own.aic === null || !best) return "";
  if (own.aic <= best.aic!) {
    const next = `next is ${best.title} with ${percent(best.rmse_share)}`;
    return `Of ${others.length + 1} models it fits best; ${next}.`;
  }
  return `${best.title} fits better, with ${percent(best.rmse_share)}: see the table of the models.`;
}
