import type { History } from "../state/history.ts";
import { cutFigures, cuts, LIMIT_WORDS, limitOf } from "../state/limits.ts";
import { feltForce, feltShare, MODEL_FORCE, scaleOf } from "../state/scale.ts";
import type { Source } from "../state/source.ts";
import type { Pane } from "./kit/axes.ts";
import { textWidth } from "./kit/labels.ts";
import type { Pen } from "./kit/pen.ts";
import { colourOf, type Theme } from "./kit/theme.ts";
import { nameOf } from "./names.ts";
import { STATE_WORDS, stateOf } from "./states.ts";

const NUMBERS = 132; // px, for the depth and the force
const ROW = 16;

const minus = (text: string): string => text.replace("-", "−");

/** A tick's numbers as text for a screen reader; with `noDepth` its forces only. */
export function reading(source: Source, tick: number, noDepth: boolean): string {
  const { history } = source;
  const parts = Array.from({ length: history.membranes }, (_, i) => {
    const depth = noDepth ? "" : ` ${(history.row("depth", tick)[i]! * 1e3).toFixed(3)} mm,`;
    const model = -history.row("axial_force", tick)[i]!;
    const felt = `${feltForce(scaleOf(source, tick))} ${(model * feltShare(history, tick)).toFixed(3)} N`;
    return `${nameOf(source, i)}${depth || ":"} ${MODEL_FORCE} ${model.toFixed(3)} N, ${felt}`;
  });
  return `${history.timeOf(tick).toFixed(4)} s, ${forceWords(history, tick)}: ${parts.join("; ")}`;
}

/** Says whether the device gets the force, and which limit cuts it. */
function forceWords(history: History, tick: number): string {
  return cuts(limitOf(history, tick))
    ? `cut to ${cutFigures(history, tick)} by the ${LIMIT_WORDS[limitOf(history, tick)]}`
    : STATE_WORDS[stateOf(history, tick)];
}

/** Draws a small table next to the cursor: the time, and of every membrane the force and, unless `noDepth`, depth. */
export function drawReading(pen: Pen, pane: Pane, source: Source, tick: number, theme: Theme, noDepth: boolean): void {
  const { history } = source;
  const x = pane.x.px(history.timeOf(tick));
  const names = Array.from({ length: history.membranes }, (_, i) => nameOf(source, i));
  const wide = NUMBERS + 22 + Math.max(...names.map((name) => textWidth(name)));
  const left = x + wide + 14 < pane.right ? x + 10 : x - wide - 10;
  const { top } = pane;
  pen.box(left, top + 2, wide, ROW * (history.membranes + 1) + 6, theme.panel, 0.92);
  const edge = { colour: theme.line, width: 1 };
  const bottom = top + ROW * (history.membranes + 1) + 8;
  pen.segment(left, top + 2, left + wide, top + 2, edge);
  pen.segment(left, bottom, left + wide, bottom, edge);
  pen.segment(left, top + 2, left, bottom, edge);
  pen.segment(left + wide, top + 2, left + wide, bottom, edge);
  const limit = limitOf(history, tick);
  const state = cuts(limit) ? LIMIT_WORDS[limit] : STATE_WORDS[stateOf(history, tick)];
  const words = `${history.timeOf(tick).toFixed(4)} s  ${state}`;
  pen.text(left + 8, top + 13, words, { colour: theme.text, bold: true });
  for (let i = 0; i < history.membranes; i++) {
    const y = top + 13 + ROW * (i + 1);
    pen.dot(left + 11, y, 4, colourOf(theme, i), theme.panel);
    pen.text(left + 20, y, names[i]!, { colour: theme.text });
    const depth = minus((history.row("depth", tick)[i]! * 1e3).toFixed(3));
    const force = minus((-history.row("axial_force", tick)[i]!).toFixed(3));
    if (!noDepth) pen.text(left + wide - 66, y, `${depth} mm`, { colour: theme.text, anchor: "end" });
    pen.text(left + wide - 8, y, `${force} N`, { colour: theme.text, anchor: "end" });
  }
}
