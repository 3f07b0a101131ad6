import { button, element, named } from "../../panel.ts";
import { colourToken } from "../../state/colours.ts";
import { Signal } from "../../state/signal.ts";
import type { Draft } from "./draft.ts";
import type { Table } from "./fields.ts";
import { group, type Inputs, showAll } from "./group.ts";
import { numberText } from "./number.ts";
import { duplicated, membranes, moved, type Tables, withMembranes } from "./tables.ts";

interface Card {
  readonly root: HTMLElement;
  readonly head: HTMLButtonElement;
  readonly title: HTMLElement;
  readonly summary: HTMLElement;
  readonly body: HTMLElement;
  readonly inputs: Inputs;
}

/** The list of membranes. One is open, and its law is drawn. */
export class MembraneList {
  readonly root = element("div", { class: "membranes" });
  readonly selected = new Signal(0);
  private cards: Card[] = [];

  constructor(
    private readonly table: Table,
    private readonly draft: Draft,
  ) {
    this.selected.watch(() => this.showSelected());
  }

  get inputs(): Inputs {
    return new Map(this.cards.flatMap((card) => [...card.inputs]));
  }

  show(tables: Tables): void {
    const all = membranes(tables);
    if (all.length !== this.cards.length) this.build(all.length);
    all.forEach((membrane, i) => {
      const card = this.cards[i]!;
      named(card.title, String(membrane.name ?? ""));
      card.summary.textContent = summaryOf(membrane);
      showAll(card.inputs, tables);
    });
  }

  /** Marks the cards that have problems. */
  mark(wrong: ReadonlySet<number>): void {
    this.cards.forEach((card, i) => {
      card.root.classList.toggle("wrong", wrong.has(i));
    });
  }

  /** Opens the membrane and focuses its header, or one of its fields. */
  focus(index: number, path?: string): void {
    this.selected.value = index;
    const card = this.cards[index];
    const field = path
      ? card?.inputs.get(path)?.root.querySelector<HTMLElement>("input:not([type=range]), select")
      : null;
    const folded = field?.closest("details");
    if (folded) folded.open = true;
    (field ?? card?.head)?.focus();
  }

  private build(count: number): void {
    this.cards = Array.from({ length: count }, (_, index) => this.card(index));
    this.root.replaceChildren(...this.cards.map((card) => card.root));
    const kept = Math.min(this.selected.value, Math.max(count - 1, 0));
    if (kept === this.selected.value) this.showSelected();
    else this.selected.value = kept;
  }

  private card(index: number): Card {
    const { root: fields, inputs } = group(this.table, [this.table.key, index], this.draft);
    const title = element("span", { class: "title" });
    const summary = element("span", { class: "summary" });
    const bodyId = `membrane-${index}-fields`;
    const swatch = element("span", { class: "swatch", "aria-hidden": "true" }, String(index + 1));
    // The page's content security policy forbids a style attribute.
    swatch.style.setProperty("--swatch", `var(--${colourToken(index)})`);
    const head = element(
      "button",
      { type: "button", class: "card-head", "aria-controls": bodyId, onclick: () => this.open(index) },
      swatch,
      title,
      summary,
    );
    const tools = membraneTools(this.draft, index, (next) => this.focus(next));
    const body = element("div", { id: bodyId, class: "card-body" }, fields, tools);
    return { root: element("div", { class: "card" }, head, body), head, title, summary, body, inputs };
  }

  private open(index: number): void {
    this.selected.value = index;
  }

  private showSelected(): void {
    this.cards.forEach((card, i) => {
      const open = i === this.selected.value;
      card.head.setAttribute("aria-expanded", String(open));
      card.body.hidden = !open;
    });
  }
}

function summaryOf(membrane: Tables): string {
  const { thickness_mm: thickness, friction } = membrane;
  return `${numberText(thickness)} mm, μ ${numberText(friction)}`;
}

/** The buttons Up, Down, Duplicate and Remove of the membrane at `index`. `go` opens a membrane afterwards. */
function membraneTools(draft: Draft, index: number, go: (index: number) => void): HTMLElement {
  const put = (all: readonly Tables[], next: number): void => {
    draft.change(withMembranes(draft.tables.value, all));
    go(Math.min(next, all.length - 1));
  };
  const now = (): readonly Tables[] => membranes(draft.tables.value);
  const up = button("Up", "Move up: forces are added in this order", () =>
    put(moved(now(), index, index - 1), index - 1),
  );
  const down = button("Down", "Move down", () => put(moved(now(), index, index + 1), index + 1));
  const copy = button("Duplicate", "Add a copy behind this one", () => put(duplicated(now(), index), index + 1));
  const remove = button("Remove", "Remove this membrane", () =>
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
