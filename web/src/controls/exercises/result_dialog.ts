import { errorText, unbroken } from "../../format.ts";
import { button, element, named } from "../../panel.ts";
import { showMoment } from "../../pop/again.ts";
import type { App } from "../../state/app.ts";
import type { Source } from "../../state/source.ts";
import { recordingPath, resultPath } from "../../wire/api.ts";
import type { ExerciseOverview, RecordingEntry, RecordingTrace, Result } from "../../wire/messages.ts";
import { saveAddress } from "../download.ts";
import { fetchSource, type Progress } from "../recordings/fetch_source.ts";
import { bytesText, dateText } from "../recordings/words.ts";
import { DRAFT, expertButton, expertSource, expertTrace, judgedBy } from "./expert.ts";
import { goalList, verdict } from "./goals.ts";
import { metricRows } from "./metrics.ts";
import { layersOf, spaceOf, traceOf } from "./trace.ts";
import { BEFORE, traceDrawing } from "./trace_drawing.ts";

const STILL_MS = 1000; // after the result has come, a key that is pressed was meant for the needle

/**
 * The dialog of a result: verdict, reasons, measures and a drawing of the attempt. `again` starts a new attempt;
 * `changed` is called after the expert's run was changed.
 */
export function openResult(
  app: App,
  result: Result,
  title: string,
  exercise: ExerciseOverview | null,
  again: (() => void) | null,
  changed: () => void,
): void {
  const stop = new AbortController();
  const place = element("div", { class: "trace-place", "aria-live": "polite" });
  const watchButton = (time: number): HTMLElement => {
    watch = button("", "", () => void showWorst(time));
    loading(true);
    return watch;
  };
  let watch: HTMLButtonElement | null = null;
  /** Loading it takes some seconds, and its progress is below, out of sight. */
  const loading = (on: boolean): void => {
    if (!watch) return;
    watch.disabled = on;
    watch.textContent = on ? "Loading the moment…" : "Watch this moment, slowly";
  };
  const look = button("Replay", "", () => void 0);
  look.disabled = true;
  const dialog = element(
    "dialog",
    { class: "result tab", "aria-labelledby": "result-title" },
    element(
      "header",
      {},
      element(
        "h2",
        // The focus goes here, so that the dialog opens with its first words and not scrolled to its buttons.
        { id: "result-title", tabindex: -1, autofocus: true },
        named(element("span"), title),
        " ",
        element("span", { class: result.passed ? "passed" : "failed" }, verdict(result)),
      ),
      element("p", { class: "quiet" }, [result.person, dateText(result.date)].filter(Boolean).join(" · ")),
    ),
    element("div", { class: "why" }, ...result.reasons.map((reason) => element("p", {}, unbroken(reason)))),
    ...coachPart(result, result.recording ? watchButton : undefined),
    element(
      "div",
      { class: "two" },
      element("section", {}, element("h3", {}, "Goals"), goalList(result.goals)),
      element("section", {}, element("h3", {}, "Measures"), table(result, exercise)),
    ),
    place,
    ...(result.name === DRAFT
      ? [element("p", { class: "quiet" }, "The result of an exercise that is not saved is not kept.")]
      : []),
    element(
      "div",
      { class: "tools" },
      button("Save JSON", "", () => save("json")),
      button("Save CSV", "", () => save("csv")),
      ...expertButton(app, result, exercise, changed),
    ),
    element(
      "footer",
      { class: "tools" },
      ...(again ? [button("Try again", "", () => close(again), "small primary")] : []),
      look,
      element("span", { class: "gap" }),
      button("Close", "", () => dialog.close(), again ? "small" : "small primary"),
    ),
  );
  const close = (then: () => void): void => {
    dialog.close();
    then();
  };
  const save = (format: string): void =>
    saveAddress(app.api.address(`${resultPath(result.name)}/download?format=${format}`), `${result.name}.${format}`);

  dialog.addEventListener("close", () => {
    stop.abort();
    for (const end of watched) end();
    dialog.remove();
  });
  const watched = closeWhenOver(app, () => dialog.close());
  document.body.append(dialog);
  dialog.showModal();
  dialog.scrollTop = 0; // the focus of its title may have scrolled it
  unscrolled(dialog);
  let entry: RecordingEntry | undefined;
  /** The worst moment in the view, and this dialog again after it. */
  const showWorst = async (time: number): Promise<void> => {
    loading(true);
    const source = entry && (await fetchWhole(app, entry, place, stop.signal));
    loading(false);
    if (!source || stop.signal.aborted || !showMoment(app, source, time)) return;
    const shown = app.source.value;
    dialog.close();
    const end = app.source.watch((now) => {
      if (now === shown) return;
      queueMicrotask(() => end());
      if (now.live && !app.exercise.value?.running) openResult(app, result, title, exercise, again, changed);
    });
  };
  void drawTrace(app, result, exercise, place, stop.signal).then((entries) => {
    entry = entries.find(({ name }) => name === result.recording);
    if (!entry) {
      watch?.remove(); // the recording was deleted, or cannot be read: the sentence below tells it
      return;
    }
    loading(false);
    look.disabled = false;
    look.addEventListener("click", () => {
      look.disabled = true;
      void fetchWhole(app, entry!, place, stop.signal).then(async (source) => {
        const expert = source && (await expertSource(app, exercise, entry!.name, entries, stop.signal));
        look.disabled = false;
        if (!source) return;
        close(() => {
          app.overlay.value = expert ?? null; // never the expert of another exercise
          app.source.value = source;
          const end = app.source.watch(({ history }) => {
            if (history === source.history) return;
            end();
            if (expert && app.overlay.value === expert) app.overlay.value = null;
          });
        });
      });
    });
  });
}

/** A hand that still pushes by a key when the result comes must not scroll past its sentence. */
function unscrolled(dialog: HTMLElement): void {
  const opened = performance.now();
  let meant = false; // the first key that is pressed here for the dialog
  dialog.addEventListener("keydown", (event) => {
    meant ||= !event.repeat && performance.now() - opened > STILL_MS;
    if (!meant && /^(Arrow|Page| $)/.test(event.key)) event.preventDefault();
  });
}

/**
 * Closes an old result when another attempt begins, and in a page that looks on also when the needle of a later run
 * touches something: nobody may be there to close it. Returns what ends that.
 */
function closeWhenOver(app: App, close: () => void): (() => void)[] {
  const { run, live, exercise, control } = app;
  const old = live.events.value.at(-1);
  const began = run.value;
  return [
    exercise.watch((status) => {
      if (status?.running) close();
    }),
    live.events.watch((events) => {
      if (control.value.you || events.length === 0 || events.at(-1) === old || run.value === began) return;
      close();
    }),
  ];
}

function table(result: Result, exercise: ExerciseOverview | null): HTMLElement {
  const rows = metricRows(result.metrics, exercise?.space_name).map(({ label, value, help }) =>
    element("tr", { title: help }, element("th", { scope: "row" }, label), element("td", {}, value)),
  );
  return element("table", { class: "metrics" }, element("tbody", {}, ...rows));
}

/** Draws the attempt, and the expert's run, from decimated traces. Returns all recordings; none after an error. */
async function drawTrace(
  app: App,
  result: Result,
  exercise: ExerciseOverview | null,
  place: HTMLElement,
  signal: AbortSignal,
): Promise<readonly RecordingEntry[]> {
  if (!result.recording) {
    place.append(element("p", { class: "quiet" }, "The attempt was not recorded."));
    return [];
  }
  place.append(element("span", { class: "quiet" }, "Loading the attempt…"));
  try {
    const response = await app.api.get(`${tracePath(result)}${judgedBy(exercise)}`, { signal });
    const trace = (await response.json()) as RecordingTrace;
    const entries = await app.api.json<RecordingEntry[]>("/api/recordings");
    const layers = layersOf(trace.membranes);
    const space = exercise && spaceOf(layers, exercise);
    const expert = await expertTrace(app, exercise, result.recording, signal);
    place.replaceChildren(traceDrawing(traceOf(trace), layers, space, result, expert));
    return entries;
  } catch (error) {
    if (!signal.aborted)
      place.replaceChildren(element("p", { class: "quiet" }, `Cannot draw the attempt: ${errorText(error)}`));
    return [];
  }
}

/** Loads every tick of the attempt for a replay; null if that failed or was cancelled. */
async function fetchWhole(
  app: App,
  entry: RecordingEntry,
  place: HTMLElement,
  signal: AbortSignal,
): Promise<Source | null> {
  const bar = element("progress", { max: 1, value: 0, "aria-label": "Loading the attempt" });
  const words = element("span", { class: "quiet" }, "Loading every tick of the attempt…");
  const line = element("p", {}, words, bar);
  place.append(line);
  try {
    const progress = ({ bytes, total }: Progress): void => {
      bar.value = bytes / total;
      words.textContent = bytesText(bytes, total);
    };
    return (await fetchSource(app.api, entry, progress, signal)).source;
  } catch (error) {
    if (!signal.aborted) app.notify(`Cannot load the attempt: ${errorText(error)}`);
    return null;
  } finally {
    line.remove();
  }
}

/** URL of the attempt's trace, from shortly before the first contact. */
export function tracePath({ recording, events }: Pick<Result, "recording" | "events">): string {
  const touch = events.find(({ what }) => what === "touch")?.time ?? 0;
  return `${recordingPath(recording)}/trace?from=${Math.max(touch - BEFORE, 0).toFixed(3)}`;
}

/**
 * One thing to change next time, and one that went well. Empty if the coach has nothing to say. watch: shows the worst
 * moment, at this time of the run (s).
 */
function coachPart({ coaching }: Pick<Result, "coaching">, watch?: (time: number) => HTMLElement): HTMLElement[] {
  const [change, good] = [coaching.change[0], coaching.good[0]];
  const when = change?.time ?? null;
  const part = (kind: string, title: string, text: string, ...more: HTMLElement[]): HTMLElement =>
    element("section", { class: `coach ${kind}` }, element("h3", {}, title), element("p", {}, unbroken(text)), ...more);
  return [
    ...(change
      ? [part("change", "What to change next time", change.text, ...(watch && when !== null ? [watch(when)] : []))]
      : []),
    ...(good ? [part("good", "What went well", good.text)] : []),
  ];
}
