import type { History } from "../state/history.ts";
import { cutFigures, cuts, LIMIT_WORDS, limitOf } from "../state/limits.ts";
import { feltForce, feltShare, MODEL_FORCE, scaleOf } from "../state/scale.ts";
import type { Source } from "../state/source.ts";
import { drawBadge } from "./badge.ts";
import type { Pane } from "./kit/axes.ts";
import type { Pen } from "./kit/pen.ts";
import type { Theme } from "./kit/theme.ts";
import { STATE_WORDS, stateOf } from "./states.ts";

const WIDTH = 158;
const ROW = 16;

const minus = (text: string): string => text.replace("-", "−");

/** A tick's numbers as text for a screen reader; with `noDepth` its forces only. */
export function reading(source: Source, tick: number, noDepth: boolean): string {
  const { history } = source;
  const names = source.scene.value?.membranes ?? [];
  const parts = Array.from({ length: history.membranes }, (_, i) => {
    const depth = noDepth ? "" : ` ${(history.row("depth", tick)[i]! * 1e3).toFixed(3)} mm,`;
    const model = -history.row("axial_force", tick)[i]!;
    const felt = `${feltForce(scaleOf(source, tick))} ${(model * feltShare(history, tick)).toFixed(3)} N`;
    return `${names[i]?.name ?? `membrane ${i + 1}`}${depth || ":"} ${MODEL_FORCE} ${model.toFixed(3)} N, ${felt}`;
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
  const left = x + WIDTH + 14 < pane.right ? x + 10 : x - WIDTH - 10;
  const { top } = pane;
  pen.box(left, top + 2, WIDTH, ROW * (history.membranes + 1) + 6, theme.panel, 0.92);
  const edge = { colour: theme.line, width: 1 };
  const bottom = top + ROW * (history.membranes + 1) + 8;
  pen.segment(left, top + 2, left + WIDTH, top + 2, edge);
  pen.segment(left, bottom, left + WIDTH, bottom, edge);
  pen.segment(left, top + 2, left, bottom, edge);
  pen.segment(left + WIDTH, top + 2, left + WIDTH, bottom, edge);
  const limit = limitOf(history, tick);
  const state = cuts(limit) ? LIMIT_WORDS[limit] : STATE_WORDS[stateOf(history, tick)];
  const words = `${history.timeOf(tick).toFixed(4)} s  ${state}`;
  pen.text(left + 8, top + 13, words, { colour: theme.text, bold: true });
  for (let i = 0; i < history.membranes; i++) {
    const y = top + 13 + ROW * (i + 1);
    drawBadge(pen, left + 14, y, i, theme);
    const depth = minus((history.row("depth", tick)[i]! * 1e3).toFixed(3));
    const force = minus((-history.row("axial_force", tick)[i]!).toFixed(3));
    if (!noDepth) pen.text(left + 92, y, `${depth} mm`, { colour: theme.text, anchor: "end" });
    pen.text(left + WIDTH - 8, y, `${force} N`, { colour: theme.text, anchor: "end" });
  }
}
