import { element, type Panel } from "../panel.ts";
import { Pane } from "../plots/kit/axes.ts";
import { Figure } from "../plots/kit/figure.ts";
import { textWidth } from "../plots/kit/labels.ts";
import type { Pen } from "../plots/kit/pen.ts";
import { colourOf, type Theme } from "../plots/kit/theme.ts";
import type { Spread, Status } from "../wire/messages.ts";
import { limitList, number } from "./limit_figures.ts";
import { servoState } from "./state_button.ts";
import { STATES } from "./words.ts";

const LABEL = 18; // px for the label below the axis
const LEAST = 0.1; // height of a count of one, as a share of the box
const EDGE = 0.995; // bins beyond the ends of the axis are drawn at the ends

/**
 * Draws a distribution of times on a logarithmic axis, with a mark at the nominal time. Heights are logarithmic too,
 * so that one late tick in a million is visible.
 */
export function drawHistogram(
  pen: Pen,
  { edges, counts, p50, largest }: Spread,
  nominal: number,
  words: (seconds: number) => string,
  width: number,
  height: number,
  theme: Theme,
): void {
  const pane = new Pane();
  pane.place(0, 0, width, height - LABEL);
  pane.rangeX(Math.min(p50, nominal) / 8, Math.max(largest, nominal) * 2, true);
  const tallest = Math.log10(Math.max(...counts, 1));
  const place = (time: number): number => Math.min(Math.max(pane.x.px(Math.max(time, 1e-12)), 0), width);
  counts.forEach((count, i) => {
    if (count <= 0) return;
    const left = Math.min(place(edges[i]!), EDGE * width);
    const tall = (tallest > 0 ? LEAST + ((1 - LEAST) * Math.log10(count)) / tallest : 1) * pane.height;
    const wide = Math.max(place(edges[i + 1] ?? edges[i]!) - left - 0.4, 1);
    pen.box(left, pane.bottom - tall, wide, tall, colourOf(theme, 0), 1);
  });
  pen.segment(0, pane.bottom, width, pane.bottom, { colour: theme.line, width: 1 });
  const mark = pane.x.px(nominal);
  pen.segment(mark, 0, mark, pane.bottom, { colour: colourOf(theme, 1), width: 1.5, dash: [4, 3] });
  const text = `${words(nominal)}: the period`;
  const x = Math.min(mark, width - textWidth(text));
  pen.text(x, height - LABEL / 2, text, { colour: theme.quiet });
}

const SPAN = 3; // s: the rate is measured over this time

/** Measures ticks per second from occasional counts of ticks. */
export class RateMeter {
  private readonly seen: Array<readonly [time: number, ticks: number]> = [];

  /** Adds a count at `time` (s). Returns the recent rate, Hz; null until there are two counts. */
  add(time: number, ticks: number): number | null {
    const last = this.seen.at(-1);
    if (last && ticks < last[1]) this.seen.length = 0; // another run
    this.seen.push([time, ticks]);
    while (this.seen.length > 2 && time - this.seen[0]![0] > SPAN) this.seen.shift();
    const [begin, count] = this.seen[0]!;
    return time > begin ? (ticks - count) / (time - begin) : null;
  }
}

const MANY_LATE = 1e-4; // share of the ticks

/** A duration with three significant digits. */
export function duration(seconds: number): string {
  const [scale, unit] = seconds >= 0.9995 ? [1, "s"] : seconds >= 0.9995e-3 ? [1e3, "ms"] : [1e6, "µs"];
  const value = seconds * scale;
  return `${value.toFixed(value >= 99.95 ? 0 : value >= 9.995 ? 1 : 2)} ${unit}`;
}

const HANDS: Readonly<Record<Status["hand"], string>> = {
  target: "simulated, follows the pointer",
  strokes: "simulated, automatic strokes",
  motion: "simulated, follows a recording",
  device: "a person at the device",
};

/** The loop's timing, sent by the server 4 times per second. */
export const healthPanel: Panel = (host, app) => {
  const rate = new RateMeter();
  const secondRate = new RateMeter();
  const figure = (label: string, help: string): [HTMLElement, (text: string, bad?: boolean) => void] => {
    const value = element("dd");
    const set = (text: string, bad = false): void => {
      value.textContent = text;
      value.classList.toggle("bad", bad);
    };
    return [element("div", { title: help }, element("dt", {}, label), value), set];
  };
  const [rateBox, setRate] = figure("rate", "Ticks per second");
  const [ticksBox, setTicks] = figure("ticks", "Ticks of this run");
  const [lateBox, setLate] = figure("late ticks", "Ticks that began later than the loop allows");
  const [lostBox, setLost] = app.engine.studio
    ? figure("lost", "Ticks that the studio was too slow to read")
    : figure("left out", "Ticks for which the browser gave this page no time");
  const [droppedBox, setDropped] = figure(
    "skipped by this page",
    "Groups of ticks that this page was too slow to show",
  );
  const [viewersBox, setViewers] = figure("pages", "Connected pages");
  const [forceBox, setForce] = figure("force", "Whether the device gives the force of the model");
  const [handBox, setHand] = figure("hand", "Who moves the needle");
  const [secondBox, setSecond] = figure(
    "second device",
    "Ticks per second of the device under the thumb, and its limits",
  );
  for (const box of [handBox, secondBox]) box.classList.add("wide");
  for (const box of [lateBox, droppedBox, viewersBox]) box.hidden = !app.engine.studio;
  const period = spread("Period", "Time from the start of one tick to the next");
  const compute = spread("Compute time", "Computing time of a tick");
  const limits = limitList();
  const statements = element("ul", { class: "health-statements" });
  const nothing = element("p", { class: "health-none" }, "No status from the loop yet.");
  const all = element(
    "div",
    { class: "health-all" },
    element(
      "dl",
      { class: "health-figures" },
      rateBox,
      ticksBox,
      lateBox,
      lostBox,
      droppedBox,
      viewersBox,
      forceBox,
      handBox,
      secondBox,
    ),
    limits.root,
    period.box,
    compute.box,
    element("h3", {}, "The machine"),
    statements,
  );
  host.append(nothing, all);

  app.hello.watch((hello) => hello && limits.show(hello.limits));
  const showForce = (): void => setForce(app.fault.value ? "Fault: no force" : (STATES[servoState(app)]?.words ?? "–"));
  app.fault.watch(showForce);
  let shown = "";
  app.status.watch((status) => {
    all.hidden = status === null;
    nothing.hidden = status !== null;
    const nominal = app.live.scene.value?.rate; // known before the first status
    if (!status || !nominal) return;
    const { history } = app.live;
    // By the times of the ticks; their arrival at this page says nothing about a studio's loop. Without a studio, the
    // ticks have a time of their own, and only the page's clock tells how fast they are made.
    const time = app.engine.studio ? history.timeOf(history.end - 1) : performance.now() / 1e3;
    const measured = history.length ? rate.add(time, history.end) : null;
    setRate(
      measured === null ? "–" : `${measured.toFixed(0)} of ${nominal.toFixed(0)} Hz`,
      measured !== null && measured < 0.98 * nominal,
    );
    setTicks(status.ticks.toLocaleString("en"));
    setLate(status.late.toLocaleString("en"), status.late > MANY_LATE * status.ticks);
    setLost(status.lost.toLocaleString("en"), status.lost > 0);
    setDropped(status.dropped.toLocaleString("en"), status.dropped > 0);
    setViewers(String(status.viewers));
    showForce();
    setHand(HANDS[status.hand]);
    secondBox.hidden = status.second === null;
    if (status.second) {
      const { ticks, rate: stated, max_force: most, continuous_force: rms, continuous_time: time } = status.second;
      const counted = secondRate.add(performance.now() / 1e3, ticks);
      const limit = `at most ${number(most)} N, ${number(rms)} N rms in any ${number(time)} s`;
      setSecond(`${counted === null ? "–" : counted.toFixed(0)} of ${stated.toFixed(0)} Hz, ${limit}`);
    }
    if (!host.hidden) {
      period.show(status.period, 1 / nominal);
      compute.show(status.compute, 1 / nominal);
    }
    const now = status.statements.join("\n");
    if (now !== shown) {
      shown = now;
      statements.replaceChildren(...now.split("\n").map((text) => element("li", {}, text)));
    }
  });
};

/** A distribution: its quantiles, and a histogram with a mark at the nominal period. */
function spread(title: string, help: string): { box: HTMLElement; show(spread: Spread, nominal: number): void } {
  const names = ["median", "99 %", "99.9 %", "largest"];
  const values = names.map(() => element("dd"));
  const figures = element("dl", {}, ...names.map((name, i) => element("div", {}, element("dt", {}, name), values[i]!)));
  let drawn: readonly [Spread, number] | null = null;
  const figure = new Figure("histogram", 74, (pen, width, height, theme) => {
    if (drawn) drawHistogram(pen, ...drawn, duration, width, height, theme);
    return `${title}, histogram`;
  });
  const box = element(
    "section",
    { class: "health-spread", title: help },
    element("h3", {}, title),
    figures,
    figure.root,
  );
  const show = (now: Spread, nominal: number): void => {
    box.hidden = now.counts.length === 0; // not measured
    if (box.hidden) return;
    [now.p50, now.p99, now.p99_9, now.largest].forEach((value, i) => {
      values[i]!.textContent = duration(value);
    });
    drawn = [now, nominal];
    figure.redraw();
  };
  return { box, show };
}
