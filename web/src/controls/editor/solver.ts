import { element } from "../../panel.ts";
import type { App } from "../../state/app.ts";
import type { Draft } from "./draft.ts";

const SOLVERS = [
  ["exact", "Exact", "Solves the contact of each tick exactly, K06 (21)–(23)."],
  ["paper", "Paper", "Takes one explicit step per tick, K06 (33)."],
] as const;

/** Chooses the solver that makes the force, and whether the plots compare it with the other one. */
export function solverControl(app: App, draft: Draft): HTMLElement {
  const buttons = SOLVERS.map(([name, label, help]) => {
    const input = element("input", { type: "radio", name: "solver", value: name });
    input.addEventListener("change", () => draft.set(["servo", "solver"], name));
    return { name, input, root: element("label", { title: help }, input, element("span", {}, label)) };
  });
  draft.tables.watch(() => {
    const now = draft.at(["servo", "solver"]) ?? "exact";
    for (const { name, input } of buttons) input.checked = name === now;
  });

  const compare = element("input", { type: "checkbox", id: "compare-solvers" });
  let asking = false;
  compare.addEventListener("change", async () => {
    asking = true;
    const reply = await app.ask({ do: "compare", on: compare.checked });
    if (!reply?.ok) compare.checked = !compare.checked;
    asking = false;
  });
  app.status.watch((status) => {
    if (status && !asking) compare.checked = status.compare;
  });

  return element(
    "fieldset",
    { class: "solver" },
    element("legend", {}, "Solver"),
    element("div", { class: "segmented" }, ...buttons.map(({ root }) => root)),
    element("label", { class: "check" }, compare, "Compare with the other solver"),
    element(
      "p",
      { class: "quiet" },
      "Exact finds each tick’s solution. Paper takes one step per tick, as printed; it can chatter in thin walls.",
    ),
  );
}
