import type { History } from "../state/history.ts";
import { cuts, LIMIT_WORDS } from "../state/limits.ts";
import type { Source } from "../state/source.ts";
import type { MembraneEvent } from "../wire/messages.ts";
import { CUT_SHADE } from "./curves.ts";
import { MARGIN, type Pane } from "./kit/axes.ts";
import { labelsThatFit } from "./kit/labels.ts";
import { type Curve, drawShade } from "./kit/legend.ts";
import type { Pen } from "./kit/pen.ts";
import { colourOf, type Theme } from "./kit/theme.ts";
import { popLabel } from "./marks.ts";
import { drawDrop } from "./pop_marks.ts";
import { eachLimit, eachState, STATE_WORDS, type State } from "./states.ts";
import type { Window } from "./window.ts";

const NAME = 62; // px that the name of the upper axis takes

/** Shades the ticks without force, and names the reason if there is space. */
export function drawStates(pen: Pen, force: Pane, depth: Pane, history: History, window: Window, theme: Theme): void {
  const { x, left, top, width } = force;
  const bottom = depth.bottom;
  const looks: Readonly<Record<State, readonly [colour: string, alpha: number]>> = {
    disarmed: [theme.quiet, 0.14],
    waiting: [theme.quiet, 0.07],
    active: ["", 0],
    faulted: [theme.danger, 0.2],
  };
  pen.within(left, top, width, bottom - top, () =>
    eachState(history, window.first, window.end, (state, first, end) => {
      const [colour, alpha] = looks[state];
      if (!alpha) return;
      const from = Math.max(left, x.px(history.timeOf(first)));
      const to = x.px(end < history.end ? history.timeOf(end) : history.timeOf(end - 1));
      pen.box(from, top, to - from, bottom - top, colour, alpha);
      if (to - from > 48) {
        const ink = state === "faulted" ? theme.danger : theme.quiet;
        pen.text(from + 4, bottom - 8, STATE_WORDS[state], { colour: ink, size: 10 });
      }
    }),
  );
}

/** Shades the ticks in which a limit cuts the force, in the force pane only; names the limit if there is space. */
export function drawLimits(pen: Pen, force: Pane, history: History, window: Window, theme: Theme): void {
  const { x, left, top, width, height } = force;
  pen.within(left, top, width, height, () =>
    eachLimit(history, window.first, window.end, (limit, first, end) => {
      if (!cuts(limit)) return;
      const from = Math.max(left, x.px(history.timeOf(first)));
      const to = x.px(end < history.end ? history.timeOf(end) : history.timeOf(end - 1));
      drawShade(pen, from, top, Math.max(1, to - from), height, theme.danger, CUT_SHADE);
      if (to - from > 96)
        pen.text(from + 4, top + height - 9, LIMIT_WORDS[limit], {
          colour: theme.danger,
          size: 11.5,
          halo: theme.panel,
        });
    }),
  );
}

/** The legend entry for drawLimits' shade, if the window has any. */
export function limitCurve(history: History, window: Window, theme: Theme): Curve[] {
  let any = false;
  eachLimit(history, window.first, window.end, (limit) => {
    any ||= cuts(limit);
  });
  return any ? [{ id: "cut", text: "cut by a limit", colour: theme.danger, shade: CUT_SHADE }] : [];
}

const FOUND_DASH = [1, 3] as const;
const foundIn = (source: Source, window: Window): readonly number[] =>
  source.punctures.value.filter((tick) => tick >= window.first && tick < window.end);

/** Marks the punctures that the live estimate found: a dotted line and a triangle at the top of the force pane. */
export function drawFound(pen: Pen, force: Pane, depth: Pane, source: Source, window: Window, theme: Theme): void {
  const { left, top, width } = force;
  pen.within(left, top, width, depth.bottom - top, () => {
    for (const tick of foundIn(source, window)) {
      const x = force.x.px(source.history.timeOf(tick));
      pen.segment(x, top, x, depth.bottom, { colour: theme.accent, width: 1.5, dash: FOUND_DASH });
      for (let row = 0; row < 5; row++)
        pen.segment(x - 5 + row, top + row + 0.5, x + 5 - row, top + row + 0.5, { colour: theme.accent, width: 1 });
    }
  });
}

/** The legend entry for drawFound's marks, if the window has any. */
export const foundCurve = (source: Source, window: Window, theme: Theme): Curve[] =>
  foundIn(source, window).length > 0
    ? [{ id: "found", text: "puncture found by the estimate", colour: theme.accent, dash: FOUND_DASH }]
    : [];

/** Marks pops with the drop of the force, and contact and exit with a notch on the zero line. */
export function drawMarks(pen: Pen, force: Pane, depth: Pane, source: Source, window: Window, theme: Theme): void {
  const inside = source.events.value.filter((event) => event.tick >= window.first && event.tick < window.end);
  const at = (event: MembraneEvent): number => force.x.px(source.history.timeOf(event.tick));
  const right = force.right;
  const bottom = depth.bottom;
  pen.within(force.left, force.top, force.width, bottom - force.top, () => {
    for (const event of inside) {
      const x = at(event);
      const colour = colourOf(theme, event.membrane);
      const y = force.y.px(0);
      if (event.what === "pop") {
        pen.segment(x, force.top, x, bottom, { colour, width: 1, alpha: 0.45, dash: [2, 3] });
        drawDrop(pen, force, x, event, theme);
      } else pen.segment(x, y - 4, x, y + 4, { colour, width: 1.5, alpha: 0.9 });
    }
  });
  const pops = inside.filter((event) => event.what === "pop");
  const labels = pops.map((event) => ({
    x: at(event) - 2,
    text: popLabel(event, source.history),
    weight: Math.abs(event.drop),
  }));
  labelsThatFit(labels, force.left + NAME, right + MARGIN.right).forEach((fits, i) => {
    const { x, text } = labels[i]!;
    if (fits) pen.text(x, force.top - 9, text, { colour: theme.text, size: 10.5 });
  });
}
