import { element } from "../../panel.ts";
import type { App } from "../../state/app.ts";
import { type ExerciseOverview, type ExerciseResult, type RecordingEntry, resultPath } from "../../wire/files.ts";
import { saveAddress } from "../download.ts";
import { fetchSource } from "../recordings/fetch_source.ts";
import { bytesText, dateText } from "../recordings/words.ts";
import { goalList, verdict } from "./goals.ts";
import { metricRows } from "./metrics.ts";
import { layersOf, spaceBetween, traceOf } from "./trace.ts";
import { traceDrawing } from "./trace_drawing.ts";

/** The page of one result: passed or not and why, the measures, the attempt drawn. `again` starts it anew. */
export function openResult(
  app: App,
  result: ExerciseResult,
  exercise: ExerciseOverview | null,
  again: (() => void) | null,
): void {
  const stop = new AbortController();
  const place = element("div", { class: "trace-place", "aria-live": "polite" });
  const button = (label: string, act: () => void, kind = ""): HTMLButtonElement =>
    element("button", { type: "button", class: `small ${kind}`, onclick: act }, label);
  const look = button("Look at it again", () => void 0);
  look.disabled = true;
  const dialog = element(
    "dialog",
    { class: "result tab", "aria-labelledby": "result-title" },
    element(
      "header",
      {},
      element(
        "h2",
        { id: "result-title" },
        result.title,
        " ",
        element("span", { class: result.passed ? "passed" : "failed" }, verdict(result)),
      ),
      element("p", { class: "quiet" }, [result.person, dateText(result.date)].filter(Boolean).join(" · ")),
    ),
    element("div", { class: "why" }, ...result.reasons.map((reason) => element("p", {}, reason))),
    element(
      "div",
      { class: "two" },
      element("section", {}, element("h3", {}, "Goals"), goalList(result.goals)),
      element("section", {}, element("h3", {}, "Measures"), table(result)),
    ),
    place,
    element(
      "footer",
      { class: "tools" },
      look,
      button("Save JSON", () => save("json")),
      button("Save CSV", () => save("csv")),
      element("span", { class: "gap" }),
      ...(again ? [button("Try again", () => close(again))] : []),
      button("Close", () => dialog.close(), "primary"),
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
    dialog.remove();
  });
  document.body.append(dialog);
  dialog.showModal();
  void drawTrace(app, result, exercise, place, stop.signal).then((source) => {
    if (!source) return;
    look.disabled = false;
    look.addEventListener("click", () =>
      close(() => {
        app.source.value = source;
      }),
    );
  });
}

function table(result: ExerciseResult): HTMLElement {
  const rows = metricRows(result.metrics).map(({ label, value, help }) =>
    element("tr", { title: help }, element("th", { scope: "row" }, label), element("td", {}, value)),
  );
  return element("table", { class: "metrics" }, element("tbody", {}, ...rows));
}

async function drawTrace(
  app: App,
  result: ExerciseResult,
  exercise: ExerciseOverview | null,
  place: HTMLElement,
  signal: AbortSignal,
): Promise<typeof app.live | null> {
  if (!result.recording) {
    place.append(element("p", { class: "quiet" }, "The attempt was not recorded."));
    return null;
  }
  const bar = element("progress", { max: 1, value: 0, "aria-label": "Fetching the attempt" });
  const words = element("span", { class: "quiet" }, "Fetching the attempt…");
  place.append(words, bar);
  try {
    const entries = await app.api.json<RecordingEntry[]>("/api/recordings");
    const entry = entries.find(({ name }) => name === result.recording);
    if (!entry) throw new Error("its recording is not there any more");
    const { source } = await fetchSource(
      app.api,
      entry,
      ({ bytes, total }) => {
        bar.value = bytes / total;
        words.textContent = bytesText(bytes, total);
      },
      signal,
    );
    const scene = source.scene.value;
    if (!scene) return null;
    const layers = layersOf(scene);
    const space = spaceBetween(layers, exercise?.space ?? scene.lumen);
    place.replaceChildren(traceDrawing(traceOf(source), layers, space, result));
    return source;
  } catch (error) {
    if (!signal.aborted)
      place.replaceChildren(
        element(
          "p",
          { class: "quiet" },
          `The attempt cannot be drawn: ${error instanceof Error ? error.message : String(error)}`,
        ),
      );
    return null;
  }
}
