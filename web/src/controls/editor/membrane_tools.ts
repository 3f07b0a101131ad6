import { element } from "../../panel.ts";
import type { Draft } from "./draft.ts";
import { duplicated, membranes, moved, type Tables, withMembranes } from "./tables.ts";

/** The buttons Up, Down, Duplicate and Remove of the membrane at `index`. `go` opens a membrane afterwards. */
export function membraneTools(draft: Draft, index: number, go: (index: number) => void): HTMLElement {
  const put = (all: readonly Tables[], next: number): void => {
    draft.change(withMembranes(draft.tables.value, all));
    go(Math.min(next, all.length - 1));
  };
  const now = (): readonly Tables[] => membranes(draft.tables.value);
  const tool = (label: string, help: string, act: () => void): HTMLButtonElement =>
    element("button", { type: "button", class: "small", title: help, onclick: act }, label);
  const up = tool("Up", "Move up: forces are added in this order", () =>
    put(moved(now(), index, index - 1), index - 1),
  );
  const down = tool("Down", "Move down", () => put(moved(now(), index, index + 1), index + 1));
  const copy = tool("Duplicate", "Add a copy behind this one", () => put(duplicated(now(), index), index + 1));
  const remove = tool("Remove", "Remove this membrane", () =>
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
    remove.title = count <= 1 ? "A scene needs at least one membrane" : "Remove this membrane";
  });
  return element("div", { class: "tools" }, up, down, copy, remove);
}
