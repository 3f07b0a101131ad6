import { element } from "../../panel.ts";
import type { Draft } from "./draft.ts";
import { duplicated, membranes, moved, type Tables, withMembranes } from "./tables.ts";

/** Up, down, duplicate, remove: for the membrane at `index`. `go` opens the one that is of interest afterwards. */
export function membraneTools(draft: Draft, index: number, go: (index: number) => void): HTMLElement {
  const put = (all: readonly Tables[], next: number): void => {
    draft.change(withMembranes(draft.tables.value, all));
    go(Math.min(next, all.length - 1));
  };
  const now = (): readonly Tables[] => membranes(draft.tables.value);
  const tool = (label: string, help: string, act: () => void): HTMLButtonElement =>
    element("button", { type: "button", class: "small", title: help, onclick: act }, label);
  const up = tool("Up", "Earlier in the file: forces are added in this order", () =>
    put(moved(now(), index, index - 1), index - 1),
  );
  const down = tool("Down", "Later in the file", () => put(moved(now(), index, index + 1), index + 1));
  const copy = tool("Duplicate", "The same once more, behind this one", () => put(duplicated(now(), index), index + 1));
  const remove = tool("Remove", "Takes this membrane out of the scene", () =>
    put(
      now().filter((_, i) => i !== index),
      Math.max(index - 1, 0),
    ),
  );
  draft.tables.watch(() => {
    const count = now().length;
    up.disabled = index === 0;
    down.disabled = index >= count - 1;
    remove.disabled = count <= 1;
    remove.title =
      count <= 1 ? "There must be at least one membrane to go through" : "Takes this membrane out of the scene";
  });
  return element("div", { class: "tools" }, up, down, copy, remove);
}
