import { element, type Panel } from "../panel.ts";
import { blockLine, watchBlock } from "./blocked.ts";
import { Library } from "./recordings/library.ts";
import { recordControl } from "./recordings/record.ts";
import { type Row, recordingRow } from "./recordings/row.ts";

/** Record, and look at what was recorded: again, against another one, or as the hand's motion. */
export const recordingsPanel: Panel = (host, app) => {
  const library = new Library(app);
  const list = element("ul", { class: "recordings-list" });
  const note = element("p", { class: "quiet pad" }, "The list comes with the connection.");
  host.append(
    element(
      "div",
      { class: "editor-top" },
      blockLine(app, "Every tick is kept, and can be run again to the last bit."),
      recordControl(app),
    ),
    list,
    note,
  );
  let rows = new Map<string, Row>();

  const mark = (): void => {
    const shown = library.nameOf(app.source.value);
    const over = library.nameOf(app.overlay.value);
    for (const [name, row] of rows) row.mark(name === shown, name === over);
  };
  let blocked = false;
  const block = (): void => {
    for (const row of rows.values()) row.block(blocked, app.hello.value?.device.simulated ?? false);
  };
  library.entries.watch((entries) => {
    if (!entries) return;
    rows = new Map(entries.map((entry) => [entry.name, recordingRow(library, entry)]));
    list.replaceChildren(...[...rows.values()].map((row) => row.root));
    note.hidden = entries.length > 0;
    note.textContent = "There is no recording yet.";
    mark();
    block();
  });
  library.trouble.watch((trouble) => {
    if (!trouble) return;
    note.hidden = false;
    note.textContent = `The list of recordings cannot be had: ${trouble}`;
  });
  app.source.watch(mark);
  app.overlay.watch(mark);
  app.hello.watch(block);
  watchBlock(app, (now) => {
    blocked = now !== null;
    block();
  });
};
