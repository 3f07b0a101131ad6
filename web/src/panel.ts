import type { App } from "./state/app.ts";

export { everyFrame } from "./frames.ts";

/** A part of the page: fills `host`, and updates itself from the app. */
export type Panel = (host: HTMLElement, app: App) => void;

type Child = Node | string;
type Attributes = Readonly<Record<string, string | number | boolean | ((event: Event) => void)>>;

/**
 * Creates an element. `on…` attributes are listeners; true is an empty attribute, false omits it. Strings are text,
 * never markup.
 */
export function element<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function") made.addEventListener(name.slice(2), value);
    else if (value !== false) made.setAttribute(name, value === true ? "" : String(value));
  }
  made.append(...children);
  return made;
}

/** A button. title: more than its words say; may be empty. kind: its classes. */
export function button(words: string, title: string, act: () => void, kind = "small"): HTMLButtonElement {
  const named = /[a-z]{2}/i.test(words); // words are their own name for a screen reader and for voice control
  const name = named || title === "" ? {} : { "aria-label": title };
  return element("button", { type: "button", class: kind, title: title || false, ...name, onclick: act }, words);
}

/** Makes an element show a name of any length: cut after two lines, the whole when the pointer rests on it. */
export function named<E extends HTMLElement>(host: E, name: string): E {
  host.classList.add("name");
  host.textContent = host.title = name;
  return host;
}

/**
 * Puts these elements into `host` in this order, as replaceChildren does, and does not touch those that are there: an
 * element that is moved or built anew while it is pressed gets no click, and loses the focus.
 */
export function keepChildren(host: Element, children: readonly Element[]): void {
  for (const old of [...host.children]) if (!children.includes(old)) old.remove();
  children.forEach((child, i) => {
    if (host.children[i] !== child) host.insertBefore(child, host.children[i] ?? null);
  });
}

/** A list in `host`. An item that is the same as before, as JSON, keeps its element; `build` makes the others. */
export function keptList<T>(host: Element, build: (item: T) => Element): (items: readonly T[]) => void {
  let known = new Map<string, Element>();
  return (items) => {
    const before = known;
    known = new Map(
      items.map((item) => {
        const words = JSON.stringify(item);
        return [words, before.get(words) ?? build(item)];
      }),
    );
    keepChildren(host, [...known.values()]);
  };
}

/** A panel in a place of its own. label: for screen readers. */
export function placed(name: string, label: string, panel: Panel, app: App): HTMLElement {
  const host = element("section", { class: `panel ${name}`, "aria-label": label });
  panel(host, app);
  return host;
}
