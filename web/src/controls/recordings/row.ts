import { errorText } from "../../format.ts";
import { button, element } from "../../panel.ts";
import { recordingPath } from "../../wire/api.ts";
import type { RecordingEntry } from "../../wire/messages.ts";
import { blockOf } from "../blocked.ts";
import { fileName, saveAddress } from "../download.ts";
import type { Library } from "./library.ts";
import { bytesText, countText, dateText, lengthText } from "./words.ts";

const FORMATS = ["parquet", "csv", "mcap"] as const;

/** A recording in the list, with its facts and buttons. */
export interface Row {
  readonly root: HTMLElement;
  /** The same recording, with other facts. The buttons stay: the user may be about to click one. */
  update(now: RecordingEntry): void;
  /** Shows whether it is replayed, and whether the plots compare with it. */
  mark(shown: boolean, compared: boolean): void;
  block(blocked: boolean, simulated: boolean): void;
}

export function recordingRow(library: Library, first: RecordingEntry): Row {
  let entry = first;
  const { app } = library;
  const line = element("p", { class: "error", role: "alert" });
  const bar = element("progress", { max: 1, value: 0, "aria-label": `Loading ${entry.name}` });
  const bytes = element("span", { class: "quiet bytes" });
  let fetching: AbortController | null = null;
  const cancel = button("Cancel", "Stop loading", () => fetching?.abort());
  const progress = element("div", { class: "tools progress", hidden: true }, bar, bytes, cancel);

  const fetched = async (then: (source: typeof app.live) => void): Promise<void> => {
    if (fetching) return;
    line.textContent = "";
    fetching = new AbortController();
    // The progress bar appears only if loading takes a while.
    const soon = setTimeout(() => {
      progress.hidden = false;
      tools.hidden = true;
    }, 150);
    try {
      const source = await library.open(
        entry,
        (now) => {
          bar.value = now.bytes / now.total;
          bytes.textContent = bytesText(now.bytes, now.total);
        },
        fetching.signal,
      );
      then(source);
    } catch (error) {
      if (!fetching.signal.aborted) line.textContent = errorText(error);
    } finally {
      clearTimeout(soon);
      fetching = null;
      progress.hidden = true;
      tools.hidden = false;
    }
  };

  const look = button("Replay", "Show it in the view, with a scrubber", () => {
    if (app.source.value.recording === entry.name) app.source.value = app.live;
    else void fetched((source) => (app.source.value = source));
  });
  const compare = button("Compare", "Draw it in the plots too", () => {
    if (app.overlay.value?.recording === entry.name) app.overlay.value = null;
    else void fetched((source) => (app.overlay.value = source));
  });
  const repeat = button("Replay motion", "The simulated hand follows the tip of this recording", () => {
    app.source.value = app.live;
    void app.ask({ do: "play_motion", recording: entry.name });
  });
  const save = element("span", { class: "save quiet" }, "Save as");
  for (const format of FORMATS) {
    const address = app.api.address(`${recordingPath(entry.name)}/download?format=${format}`);
    save.append(
      " ",
      button(format, `Save as ${format.toUpperCase()} file`, () => saveAddress(address, fileName(entry.name, format))),
    );
  }
  save.querySelectorAll("button").forEach((each) => {
    each.className = "link";
  });

  const sure = element("span", { class: "tools sure", hidden: true });
  const remove = button("Delete", "Delete the file; asks for confirmation", () => ask(true));
  const ask = (open: boolean): void => {
    sure.hidden = !open;
    remove.hidden = open;
    save.hidden = open;
    (open ? keep : remove).focus();
  };
  const keep = button("Cancel", "Keep the file", () => ask(false));
  const really = button("Delete permanently", "This cannot be undone", async () => {
    try {
      await library.remove(entry);
    } catch (error) {
      line.textContent = errorText(error);
      ask(false);
    }
  });
  really.classList.add("danger");
  sure.append(keep, really);

  const title = element("strong", { title: entry.name });
  const facts = element("span", { class: "quiet" });
  const update = (now: RecordingEntry): void => {
    entry = now;
    title.textContent = entry.title || entry.name;
    facts.textContent = factsOf(entry).join(" · ");
  };
  update(first);
  const tools = element(
    "div",
    { class: "row-tools" },
    element("div", { class: "tools" }, look, compare, repeat),
    element("div", { class: "tools" }, save, element("span", { class: "gap" }), remove, sure),
  );
  const root = element(
    "li",
    { class: "recording" },
    element("div", { class: "what" }, title, facts),
    tools,
    progress,
    line,
  );
  return {
    root,
    update,
    mark: (shown, compared) => {
      root.classList.toggle("shown", shown);
      look.textContent = shown ? "Back to live" : "Replay";
      look.setAttribute("aria-pressed", String(shown));
      compare.textContent = compared ? "Stop" : "Compare";
      compare.title = compared ? "Stop comparing" : "Draw it in the plots too";
      compare.setAttribute("aria-pressed", String(compared));
    },
    block: (blocked, simulated) => {
      const judged = app.exercise.value?.running ?? false; // the studio refuses it then
      repeat.disabled = judged || (blocked && blockOf(app)?.remedy !== "live");
      repeat.hidden = !simulated;
    },
  };
}

const factsOf = (entry: RecordingEntry): string[] =>
  [
    entry.scene,
    lengthText(entry.seconds),
    dateText(entry.started),
    entry.exercise && `exercise ${entry.exercise}`,
    entry.lost > 0 && `${countText(entry.lost)} ticks lost`,
    !entry.finished && "not finished",
  ].filter((fact): fact is string => Boolean(fact));
