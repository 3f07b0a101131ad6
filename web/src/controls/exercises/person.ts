import { element } from "../../panel.ts";
import { keep, storage } from "../../state/remembered.ts";
import { Signal } from "../../state/signal.ts";

const KEY = "punctura.person";
const GROUP_KEY = "punctura.class";
const LONGEST_NAME = 80;

/** The name of the person who practises, stored in this browser. */
export class Person {
  readonly name: Signal<string>;
  /** The person's class; may be empty. */
  readonly group: Signal<string>;

  constructor(private readonly store: Pick<Storage, "getItem" | "setItem"> | null = storage()) {
    this.name = new Signal(this.store?.getItem(KEY) ?? "");
    this.group = new Signal(this.store?.getItem(GROUP_KEY) ?? "");
  }

  set(name: string): void {
    this.name.value = this.tidied(KEY, name);
  }

  setGroup(name: string): void {
    this.group.value = this.tidied(GROUP_KEY, name);
  }

  private tidied(key: string, name: string): string {
    const tidy = name.trim().replace(/\s+/g, " ").slice(0, LONGEST_NAME);
    keep(key, tidy, this.store);
    return tidy;
  }
}

/** The fields for the name and the class. */
export function personFields(person: Person): HTMLElement[] {
  return [
    wordField("person-name", "Your name", "for your results", person.name, (name) => person.set(name)),
    wordField("person-class", "Class", "may be left empty", person.group, (name) => person.setGroup(name)),
  ];
}

function wordField(
  id: string,
  label: string,
  placeholder: string,
  value: Signal<string>,
  set: (name: string) => void,
): HTMLElement {
  const box = element("input", {
    type: "text",
    id,
    class: "words",
    maxlength: LONGEST_NAME,
    autocomplete: id === "person-name" ? "name" : "off",
    placeholder,
  });
  box.addEventListener("change", () => set(box.value));
  value.watch((name) => {
    box.value = name;
  });
  return element("div", { class: "field person" }, element("label", { for: id }, label), box);
}
