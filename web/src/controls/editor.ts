import { errorText } from "../format.ts";
import { button, element, everyFrame, type Panel } from "../panel.ts";
import type { App } from "../state/app.ts";
import { codeOf } from "../wire/ticks.ts";
import { blockLine, watchBlock } from "./blocked.ts";
import { Draft } from "./editor/draft.ts";
import { type SceneForm, sceneForm, type Table } from "./editor/fields.ts";
import { sceneTools } from "./editor/files.ts";
import { group, type Inputs, showAll } from "./editor/group.ts";
import { lawDrawing } from "./editor/laws.ts";
import { MembraneList } from "./editor/membranes.ts";
import { sortProblems } from "./editor/problems.ts";
import { solverControl } from "./editor/solver.ts";
import { duplicated, membranes, withMembranes } from "./editor/tables.ts";

const OUTSIDE = codeOf("phase", "outside");

/** The scene as forms, made from its JSON Schema. Changes take effect while the loop runs. */
export const editorPanel: Panel = (host, app) => {
  host.classList.add("editor");
  const wait = element("p", { class: "quiet pad" }, "Waiting for the connection…");
  host.append(wait);
  let asked = false;
  app.connection.watch(async (now) => {
    if (now.state !== "open" || asked) return;
    asked = true;
    try {
      const form = sceneForm(await app.api.json("/api/schema"));
      wait.remove();
      build(host, app, form);
    } catch (error) {
      asked = false;
      wait.textContent = `Cannot load the scene’s form: ${errorText(error)}`;
    }
  });
};

function build(host: HTMLElement, app: App, form: SceneForm): void {
  const draft = new Draft(app);
  const problemReport = report();
  const membraneTable = form.tables.find((table) => table.list);
  const single = form.tables.filter((table) => !table.list);
  if (!membraneTable) throw new Error("the schema has no list of membranes");

  const list = new MembraneList(membraneTable, draft);
  const add = button("Add a membrane", "", () => addMembrane(draft, list));
  const top = group({ fields: form.fields, pairs: [] }, [], draft);
  const parts = single.map((table) => ({ table, ...group(table, [table.key], draft, ["solver"]) }));
  const inputs = (): Inputs => new Map([...top.inputs, ...parts.flatMap((part) => [...part.inputs]), ...list.inputs]);

  const [needle, ...others] = parts;
  const sections = others.map(({ table, root }) => ({ table, root: section(table, root, table.key !== "servo") }));
  const fields = element(
    "fieldset",
    { class: "fields" },
    solverControl(app, draft),
    top.root,
    element("h3", {}, membraneTable.title),
    list.root,
    element("div", { class: "tools" }, add),
    ...(needle ? [section(needle.table, needle.root, true)] : []),
    ...sections.map(({ root }) => root),
  );
  const drawing = lawDrawing();
  const tools = element(
    "fieldset",
    { class: "bare" },
    sceneTools(app, draft, (lines) => problemReport.show(lines.map((text) => ({ text })))),
  );
  host.append(
    element(
      "div",
      { class: "editor-top" },
      blockLine(app, "Changes take effect at once, also inside tissue.", "scene"),
      tools,
    ),
    element(
      "div",
      { class: "law-place" },
      problemReport.root,
      drawing.root,
      helpLine(fields, "Friction band of the open membrane. Dashed: before the last change. Dot: the needle’s tip."),
    ),
    fields,
    figuresLink(app),
  );

  watchBlock(
    app,
    (block) => {
      fields.disabled = block !== null;
      tools.disabled = block !== null;
    },
    "scene",
  );
  draft.tables.watch((tables) => {
    list.show(tables);
    showAll(top.inputs, tables);
    for (const part of parts) showAll(part.inputs, tables);
    for (const { table, root } of sections) root.hidden = table.optional && tables[table.key] === undefined;
    // Only liquid from a syringe meets these.
    for (const [path, input] of list.inputs)
      if (/\.(outflow|behind)_/.test(path)) input.root.hidden = tables.syringe === undefined;
  });
  draft.problems.watch((problems) => showProblems(problems));
  list.selected.watch(() => showProblems(draft.problems.value));
  host.addEventListener("keydown", (event) => {
    if (!(event.ctrlKey || event.metaKey) || event.key.toLowerCase() !== "z" || fields.disabled) return;
    event.preventDefault();
    if (event.shiftKey) draft.redo();
    else draft.undo();
  });

  function showProblems(problems: typeof draft.problems.value): void {
    const shown = inputs();
    const sorted = sortProblems(problems, new Set(shown.keys()));
    for (const [path, input] of shown) input.complain(sorted.fields.get(path) ?? "");
    const lines: ReportLine[] = sorted.others.map((text) => ({ text }));
    const wrong = new Set<number>();
    for (const [path, reason] of sorted.fields) {
      const index = /^membrane\[(\d+)\]/.exec(path)?.[1];
      if (index === undefined) continue;
      wrong.add(Number(index));
      if (Number(index) !== list.selected.value)
        lines.push({
          text: `${String(draft.at(["membrane", Number(index), "name"]))}: ${reason}`,
          go: () => list.focus(Number(index), path),
        });
    }
    list.mark(wrong);
    problemReport.show(lines);
  }

  const showLaw = (): void => {
    const at = list.selected.value;
    drawing.show(app.live.laws.value[at] ?? null, draft.before.value[at] ?? null);
  };
  app.live.laws.watch(showLaw);
  draft.before.watch(showLaw);
  list.selected.watch(showLaw);
  everyFrame(() => {
    if (host.hidden || !app.source.value.live) return;
    const tick = app.live.shown();
    const at = list.selected.value;
    if (tick === null || at >= app.live.history.membranes) return drawing.mark(null, 0);
    const inside = (app.live.history.byteRow("phase", tick)[at] ?? OUTSIDE) !== OUTSIDE;
    drawing.mark(
      inside ? app.live.history.row("depth", tick)[at]! : null,
      app.live.history.row("axial_force", tick)[at]!,
    );
  });
}

function section(table: Table, content: HTMLElement, open: boolean): HTMLElement {
  return element(
    "details",
    { class: "section", open },
    element("summary", {}, table.title),
    element("p", { class: "quiet" }, table.help),
    content,
  );
}

function addMembrane(draft: Draft, list: MembraneList): void {
  const all = membranes(draft.tables.value);
  const next = duplicated(all, all.length - 1);
  draft.change(withMembranes(draft.tables.value, next));
  list.focus(next.length - 1);
}

const PATH = "/figures/";

/** A link to the page of the paper's figures, or the command that makes the page. */
function figuresLink(app: App): HTMLElement {
  const link = element("a", { href: app.api.address(PATH), target: "_blank", rel: "noopener" }, "Figures of the paper");
  const made = element("span", { hidden: true }, link, ": K06 Figs. 3, 5, 10, 11 and 12, computed by this model.");
  const missing = element(
    "span",
    {},
    "The paper’s figures, computed by this model: ",
    element("code", {}, "punctura reproduce"),
    " makes the page.",
  );
  app.hello.watch((hello) => {
    made.hidden = !hello?.figures;
    missing.hidden = hello?.figures ?? false;
  });
  return element("p", { class: "quiet pad figures" }, made, missing);
}

/** One place for the help of the field under the pointer or focus, because there is no space for help at each field. */
function helpLine(form: HTMLElement, standing: string): HTMLElement {
  const line = element("p", { class: "help-line", "aria-hidden": "true" }, standing);
  const look = (target: EventTarget | null): void => {
    const field = target instanceof Element ? target.closest<HTMLElement>("[data-help]") : null;
    line.textContent = field?.dataset.help || standing;
  };
  form.addEventListener("pointerover", (event) => look(event.target));
  form.addEventListener("pointerleave", () => look(document.activeElement));
  form.addEventListener("focusin", (event) => look(event.target));
  return line;
}

interface ReportLine {
  readonly text: string;
  /** Opens the field, if it is hidden. */
  readonly go?: () => void;
}

/** A list of the problems that no visible field shows. Hidden while it is empty. */
function report(): { root: HTMLElement; show(lines: readonly ReportLine[]): void } {
  const root = element("div", { class: "report", role: "alert", hidden: true });
  return {
    root,
    show: (lines) => {
      root.hidden = lines.length === 0;
      root.replaceChildren(
        ...lines.map(({ text, go }) => element("p", {}, text, ...(go ? [" ", button("Show", "", go, "link")] : []))),
      );
    },
  };
}
