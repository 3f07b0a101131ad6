import { element, type Panel } from "../panel.ts";
import { Figure } from "../plots/kit/figure.ts";
import type { Spread, Status } from "../wire/messages.ts";
import { drawHistogram } from "./histogram.ts";
import { limitList, number } from "./limit_figures.ts";
import { RateMeter } from "./rate.ts";
import { servoState } from "./state_button.ts";
import { STATES } from "./words.ts";

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
