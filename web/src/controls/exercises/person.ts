import { element } from "../../panel.ts";
import { Signal } from "../../state/signal.ts";

const KEY = "punctura.person";
export const LONGEST_NAME = 80;

/** The name of the person who practises, stored in this browser. */
export class Person {
  readonly name: Signal<string>;

  constructor(private readonly store: Pick<Storage, "getItem" | "setItem"> | null = storage()) {
    this.name = new Signal(this.store?.getItem(KEY) ?? "");
  }

  set(name: string): void {
    const tidy = name.trim().replace(/\s+/g, " ").slice(0, LONGEST_NAME);
    this.store?.setItem(KEY, tidy);
    this.name.value = tidy;
  }
}

/** The browser's local storage; null if the page may not use it. */
export function storage(): Storage | null {
  try {
    return globalThis.localStorage ?? null;
  } catch {
    return null;
  }
}

export function personField(person: Person): HTMLElement {
  const box = element("input", {
    type: "text",
    id: "person-name",
    class: "words",
    maxlength: LONGEST_NAME,
    autocomplete: "name",
    placeholder: "for your results",
  });
  box.addEventListener("change", () => person.set(box.value));
  person.name.watch((name) => {
    box.value = name;
  });
  return element("div", { class: "field person" }, element("label", { for: "person-name" }, "Your name"), box);
}
