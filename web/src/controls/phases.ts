import { fixedNumber } from "../format.ts";
import { element, everyFrame, named, type Panel } from "../panel.ts";
import { plotsOf } from "../plots/shared.ts";
import { feltForce, feltShare, MODEL_FORCE, scaleOf } from "../state/scale.ts";
import { badge } from "./badge.ts";
import { eventList } from "./events.ts";
import { phaseWords } from "./words.ts";

const INTERVAL = 100; // ms between updates; faster ones cannot be read

/** Sets a text only if it has changed, because every change costs a new layout of the page. */
function write(node: HTMLElement, text: string): void {
  if (node.textContent !== text) node.textContent = text;
}

interface Row {
  readonly row: HTMLTableRowElement;
  readonly phase: HTMLElement;
  readonly symbol: HTMLElement;
  readonly word: HTMLElement;
  readonly detail: HTMLElement;
  readonly depth: HTMLElement;
  readonly force: HTMLElement;
  readonly felt: HTMLElement;
  readonly band: HTMLElement;
  readonly needle: HTMLElement;
}

function makeRow(index: number, name: string): Row {
  const [symbol, word, detail] = ["phase-symbol", "phase-word", "phase-detail"].map((c) =>
    element("span", { class: c }),
  );
  const phase = element("span", { class: "phase" }, symbol!, word!, " ", detail!);
  const [depth, force, felt, band] = [0, 1, 2, 3].map(() => element("span", { class: "number" }));
  const needle = element("i", {});
  const gauge = element("span", { class: "band-gauge", "aria-hidden": "true" }, needle);
  const head = element("th", { scope: "row" }, badge(index), named(element("span", { class: "membrane-name" }), name));
  const cells = [phase, depth!, force!, felt!].map((node) => element("td", {}, node));
  const row = element("tr", {}, head, ...cells, element("td", {}, band!, gauge));
  return {
    row,
    phase,
    symbol: symbol!,
    word: word!,
    detail: detail!,
    depth: depth!,
    force: force!,
    felt: felt!,
    band: band!,
    needle,
  };
}

/** The table of membranes with their phases, and the list of events. */
export const phasesPanel: Panel = (host, app) => {
  const plots = plotsOf(app);
  const when = element("span", { class: "phases-when" });
  const body = element("tbody");
  const columns = ["membrane", "phase", "depth along needle, mm", `${MODEL_FORCE}, N`, "", "friction band, N"];
  const heads = columns.map((text) => element("th", { scope: "col" }, text));
  const head = element("tr", {}, ...heads);
  host.append(
    element("div", { class: "phases-head" }, element("h2", {}, "Membranes"), when),
    element("table", { class: "phases-table" }, element("thead", {}, head), body),
    element("h3", { class: "phases-title" }, "Events"),
    eventList(app),
  );

  let rows: Row[] = [];
  let seen = -1; // the tick that the rows show
  const build = (): void => {
    const { source } = plots;
    const membranes = source.scene.value?.membranes ?? [];
    rows = Array.from({ length: Math.max(membranes.length, source.history.membranes) }, (_, i) =>
      makeRow(i, membranes[i]?.name ?? `membrane ${i + 1}`),
    );
    body.replaceChildren(...rows.map(({ row }) => row));
    seen = -1; // the new rows are empty
  };
  let leave = (): void => {};
  app.source.watch((source) => {
    leave();
    leave = source.scene.watch(build);
  });

  const fill = (tick: number): void => {
    const { history, laws } = plots.source;
    const depths = history.row("depth", tick);
    const forces = history.row("axial_force", tick);
    const lowers = history.row("lower", tick);
    const uppers = history.row("upper", tick);
    const phases = history.byteRow("phase", tick);
    const share = feltShare(history, tick);
    write(heads[4]!, `${feltForce(scaleOf(plots.source, tick)).replace("× ", "×\u00a0")}, N`);
    rows.forEach((row, i) => {
      const depth = depths[i] ?? Number.NaN;
      const through = laws.value[i]?.through ?? Number.POSITIVE_INFINITY;
      const { kind, symbol, word, detail } = phaseWords(phases[i] ?? 0, depth, through);
      if (row.phase.dataset.kind !== kind) row.phase.dataset.kind = kind;
      write(row.symbol, symbol);
      write(row.word, word);
      write(row.detail, detail);
      write(row.depth, fixedNumber(depth * 1e3, 2));
      // As in the plots: positive pushes the needle out, against the hand.
      const force = -(forces[i] ?? Number.NaN);
      const low = -(uppers[i] ?? Number.NaN);
      const high = -(lowers[i] ?? Number.NaN);
      const inside = high > low;
      write(row.force, fixedNumber(force, 3));
      write(row.felt, fixedNumber(force * share, 3));
      write(row.band, inside ? `${fixedNumber(low, 2)} to ${fixedNumber(high, 2)}` : "–");
      row.needle.style.left = inside
        ? `${(100 * Math.min(1, Math.max(0, (force - low) / (high - low)))).toFixed(1)}%`
        : "50%";
      row.needle.style.visibility = inside ? "inherit" : "hidden";
    });
  };

  let last = 0;
  everyFrame((now) => {
    if (now - last < INTERVAL) return;
    last = now;
    const { history } = plots.source;
    if (rows.length !== Math.max(history.membranes, plots.source.scene.value?.membranes.length ?? 0)) build();
    const tick = plots.source.shown();
    if (tick === null || tick === seen) return;
    seen = tick;
    const time = `${history.timeOf(tick).toFixed(3)} s`;
    write(when, plots.source.pointed.value === null ? time : `under the cursor: ${time}`);
    fill(tick);
  });
};
