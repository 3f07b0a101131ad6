import { button, element } from "../../panel.ts";
import type { App } from "../../state/app.ts";
import { fileName, saveAddress } from "../download.ts";
import type { Draft } from "./draft.ts";
import { sentence } from "./problems.ts";

const LARGEST = 200_000; // characters; the server refuses more

/** Undo, redo, reset, load and save. `report` gets the problems of a load; none if it succeeded. */
export function sceneTools(app: App, draft: Draft, report: (problems: readonly string[]) => void): HTMLElement {
  const undo = button("Undo", "Undo (Ctrl+Z)", () => draft.undo());
  const redo = button("Redo", "Redo (Ctrl+Shift+Z)", () => draft.redo());
  const reset = button("Reset", "Restore the loaded scene", () => draft.reset());
  draft.can.watch((can) => {
    undo.disabled = !can.undo;
    redo.disabled = !can.redo;
    reset.disabled = !can.reset;
  });

  const file = element("input", { type: "file", accept: ".toml", hidden: true, "aria-label": "Scene file" });
  const load = button("Load…", "Load a scene file (TOML) as a new run", () => file.click());
  file.addEventListener("change", async () => {
    const chosen = file.files?.[0];
    file.value = "";
    if (chosen) report(await loadFile(app, chosen));
  });
  const save = button("Save", "Save the scene as a TOML file", () => {
    saveAddress(app.api.address("/api/scene.toml"), fileName(String(draft.at(["name"]) ?? "scene"), "toml"));
  });
  return element(
    "div",
    { class: "tools scene-tools" },
    undo,
    redo,
    reset,
    element("span", { class: "gap" }),
    load,
    file,
    save,
  );
}

async function loadFile(app: App, file: File): Promise<string[]> {
  if (file.size > 4 * LARGEST)
    return [`${file.name} is too large for a scene file: ${(file.size / 1e6).toFixed(1)} MB.`];
  const toml = await file.text();
  if (toml.length > LARGEST) return [`${file.name} is too long for a scene file: at most ${LARGEST} characters.`];
  const reply = await app.ask({ do: "load_text", toml });
  if (!reply) return [`${file.name} was not loaded: no connection.`];
  if (reply.ok) return [];
  const problems = reply.problems.map(sentence);
  return [`${file.name} was not loaded; the run continues unchanged.`, ...(problems.length ? problems : [reply.text])];
}
