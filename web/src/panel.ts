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

/** Makes an element show a name of any length: cut after two lines, the whole when the pointer rests on it. */
export function named<E extends HTMLElement>(host: E, name: string): E {
  host.classList.add("name");
  host.textContent = host.title = name;
  return host;
}

/** A panel in a place of its own. label: for screen readers. */
export function placed(name: string, label: string, panel: Panel, app: App): HTMLElement {
  const host = element("section", { class: `panel ${name}`, "aria-label": label });
  panel(host, app);
  return host;
}
