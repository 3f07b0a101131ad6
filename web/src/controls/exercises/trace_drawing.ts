import { element } from "../../panel.ts";
import type { ExerciseResult } from "../../wire/files.ts";
import { ticksOf } from "../editor/law_shape.ts";
import { svg } from "../svg.ts";
import { peakText } from "./metrics.ts";
import { envelope, indexAt, type Layer, type Trace } from "./trace.ts";

const WIDTH = 680;
const LEFT = 46;
const RIGHT = 108;
const DEPTH = { top: 26, height: 150 };
const FORCE = { top: 200, height: 96 };
const HEIGHT = 330;
const COLUMNS = WIDTH - LEFT - RIGHT;
/** The drawing begins this long before the first contact, s. */
export const BEFORE = 0.5;
const WORD = 52; // px
const BELOW = 2e-3; // m: drawn depth of a space without an end

type Scale = (value: number) => number;
const scale =
  (from: number, to: number, start: number, length: number): Scale =>
  (value) =>
    start + ((value - from) / (to - from)) * length;

/** Draws depth and model force of an attempt over time, with layers, the space to reach, pops and the peak force. */
export function traceDrawing(
  trace: Trace,
  layers: readonly Layer[],
  space: Layer | null,
  result: ExerciseResult,
): HTMLElement {
  const touch = result.events.find(({ what }) => what === "touch")?.time ?? trace.time[0] ?? 0;
  const from = indexAt(trace.time, touch - BEFORE);
  const to = trace.time.length;
  const [start, end] = [trace.time[from] ?? 0, trace.time[to - 1] ?? 1];
  const x = scale(start, Math.max(end, start + 1e-3), LEFT, COLUMNS);
  const deepest = Math.max(...layers.map(({ bottom }) => bottom), 0) * 1e3;
  const reached = extreme(trace.depth, from, to, Math.max) * 1e3;
  const shallow = Math.max(-4, Math.min(extreme(trace.depth, from, to, Math.min) * 1e3, -1));
  const wanted = space ? Math.min(space.bottom, space.top + BELOW) * 1e3 : 0;
  const low = Math.max(deepest, reached, wanted) * 1.06;
  const y = scale(shallow, low, DEPTH.top, DEPTH.height);
  const strongest = Math.max(extreme(trace.force, from, to, Math.max), 0.1);
  const weakest = Math.min(extreme(trace.force, from, to, Math.min), 0);
  const f = scale(strongest * 1.15, weakest, FORCE.top, FORCE.height);

  const drawing = svg(
    "svg",
    { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: "img", class: "trace" },
    svg("title", {}, wordsOf(result)),
  );
  const add = (...nodes: SVGElement[]): void => drawing.append(...nodes);
  if (space) add(...band({ ...space, bottom: Math.min(space.bottom, low / 1e3) }, y, "space", "to reach"));
  for (const layer of layers) add(...band(layer, y, "layer", layer.name));
  add(
    ...axis(ticksOf(Math.ceil(shallow), low), y, "depth, mm", DEPTH),
    ...axis(ticksOf(weakest, strongest * 1.15), f, "model force, N", FORCE),
  );
  for (const second of ticksOf(0, end - start)) {
    const at = x(start + second);
    add(svg("text", { x: at, y: FORCE.top + FORCE.height + 14, "text-anchor": "middle" }, String(second)));
  }
  add(svg("text", { x: LEFT + COLUMNS / 2, y: HEIGHT - 2, "text-anchor": "middle" }, "time, s"));
  add(...marks(result, touch, x, end));
  const mm = trace.depth.map((depth) => depth * 1e3);
  add(curve("depth", mm, trace, from, to, x, y), curve("force", trace.force, trace, from, to, x, f));
  const peak = indexOfMost(trace.force, from, indexAt(trace.time, touch + result.metrics.total_time));
  if (peak !== null) {
    const [px, py] = [x(trace.time[peak]!), f(trace.force[peak]!)];
    add(svg("circle", { class: "peak", cx: px, cy: py, r: 3.5 }));
    add(svg("text", { class: "strong", x: px + 7, y: py + 1 }, peakText(result)));
  }
  return element(
    "figure",
    { class: "trace-figure" },
    drawing,
    element(
      "figcaption",
      { class: "quiet" },
      "This is the tip’s depth. Goals use the model’s depth: the tip pushes a wall ahead before it pierces it.",
    ),
  );
}

function band({ top, bottom }: Layer, y: Scale, kind: string, label: string): SVGElement[] {
  const [y0, y1] = [y(top * 1e3), y(bottom * 1e3)];
  return [
    svg("rect", { class: kind, x: LEFT, y: y0, width: COLUMNS, height: Math.max(y1 - y0, 1) }),
    svg("text", { class: `${kind}-name`, x: LEFT + COLUMNS + 6, y: (y0 + y1) / 2 + 4 }, label),
  ];
}

function axis(values: readonly number[], y: Scale, label: string, { top, height }: typeof DEPTH): SVGElement[] {
  const middle = top + height / 2;
  return [
    ...values.flatMap((value) => [
      svg("line", { x1: LEFT, x2: LEFT + COLUMNS, y1: y(value), y2: y(value) }),
      svg("text", { x: LEFT - 6, y: y(value) + 4, "text-anchor": "end" }, String(value).replace("-", "−")),
    ]),
    svg("text", { x: 12, y: middle, "text-anchor": "middle", transform: `rotate(-90 12 ${middle})` }, label),
  ];
}

/** Lines for the pops, the first arrival in the space and the decision. */
function marks(result: ExerciseResult, touch: number, x: Scale, end: number): SVGElement[] {
  const { time_to_target: arrival, total_time: total } = result.metrics;
  const pops = result.events.filter(({ what, time }) => what === "pop" && time <= end);
  // If two marks are close together, their labels go to opposite sides.
  const near = arrival !== null && total > 0 && x(touch + total) - x(touch + arrival) < WORD;
  const upright = (kind: string, time: number, label: string, row: number, left = false): SVGElement[] => [
    svg("line", { class: kind, x1: x(time), x2: x(time), y1: DEPTH.top - 4, y2: FORCE.top + FORCE.height }),
    svg(
      "text",
      {
        class: `${kind}-name`,
        x: x(time) + (left ? -3 : 3),
        y: DEPTH.top - 6 - 10 * row,
        "text-anchor": left ? "end" : "start",
      },
      label,
    ),
  ];
  return [
    ...pops.flatMap(({ time }, i) => upright("pop", time, `pop ${i + 1}`, crowded(pops, i) ? 1 : 0)),
    ...(arrival === null ? [] : upright("arrival", touch + arrival, "arrived", 1, near)),
    ...(total > 0
      ? upright(result.passed ? "done" : "lost", touch + total, result.passed ? "✓ done" : "✕ lost", 1)
      : []),
  ];
}

const crowded = (pops: readonly { readonly time: number }[], i: number): boolean =>
  i % 2 === 1 && pops[i]!.time - pops[i - 1]!.time < 0.6;

function curve(
  kind: string,
  values: Float64Array,
  trace: Trace,
  from: number,
  to: number,
  x: Scale,
  y: Scale,
): SVGElement {
  const pieces = envelope(trace.time, values, from, to, COLUMNS);
  const path = pieces.map((piece) => {
    const points: string[] = [];
    for (let i = 0; i < piece.length; i += 2) points.push(`${x(piece[i]!).toFixed(1)},${y(piece[i + 1]!).toFixed(1)}`);
    return `M${points.join("L")}`;
  });
  return svg("path", { class: `curve ${kind}`, d: path.join("") });
}

function extreme(values: Float64Array, from: number, to: number, of: (a: number, b: number) => number): number {
  let found = 0;
  for (let i = from; i < to; i++) if (Number.isFinite(values[i])) found = of(found, values[i]!);
  return found;
}

function indexOfMost(values: Float64Array, from: number, to: number): number | null {
  let best: number | null = null;
  for (let i = from; i < to; i++)
    if (Number.isFinite(values[i]) && (best === null || values[i]! > values[best]!)) best = i;
  return best;
}

function wordsOf({ events }: ExerciseResult): string {
  const pops = events
    .filter(({ what }) => what === "pop")
    .map(({ name, time }) => `through ${name} at ${time.toFixed(1)} s`);
  return `Depth of the tip and model force over time. ${pops.join(", ")}.`;
}
