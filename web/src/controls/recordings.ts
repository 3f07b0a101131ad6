import { element, keepChildren, type Panel } from "../panel.ts";
import { blockLine, watchBlock } from "./blocked.ts";
import { Library } from "./recordings/library.ts";
import { recordControl } from "./recordings/record.ts";
import { type Row, recordingRow } from "./recordings/row.ts";

/** Records runs, and lists the recordings: replay, compare, or use them as the hand's motion. */
export const recordingsPanel: Panel = (host, app) => {
  const library = new Library(app);
  const list = element("ul", { class: "recordings-list" });
  const note = element("p", { class: "quiet pad" }, "Waiting for the connection…");
  host.append(
    element(
      "div",
      { class: "editor-top" },
      blockLine(app, "A recording holds every tick.", "scene"),
      recordControl(app),
    ),
    list,
    note,
  );
  let rows = new Map<string, Row>();

  const mark = (): void => {
    const shown = app.source.value.recording;
    const over = app.overlay.value?.recording;
    for (const [name, row] of rows) row.mark(name === shown, name === over);
  };
  let blocked = false;
  const block = (): void => {
    for (const row of rows.values()) row.block(blocked, app.hello.value?.device.simulated ?? false);
  };
  library.entries.watch((entries) => {
    if (!entries) return;
    const before = rows;
    for (const entry of entries) before.get(entry.name)?.update(entry);
    rows = new Map(entries.map((entry) => [entry.name, before.get(entry.name) ?? recordingRow(library, entry)]));
    keepChildren(
      list,
      [...rows.values()].map(({ root }) => root),
    );
    note.hidden = entries.length > 0;
    note.textContent = "No recordings yet.";
    mark();
    block();
  });
  library.trouble.watch((trouble) => {
    if (!trouble) return;
    note.hidden = false;
    note.textContent = `Cannot load the list of recordings: ${trouble}`;
  });
  app.source.watch(mark);
  app.overlay.watch(mark);
  app.hello.watch(block);
  app.exercise.watch(block);
  watchBlock(app, (now) => {
    blocked = now !== null;
    block();
  });
};
