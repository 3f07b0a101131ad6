import { element } from "../../panel.ts";

export type Entry = readonly [text: string, act: () => void, hint?: string];

/** A button that opens a list of buttons. Escape, a choice or a click elsewhere closes it. */
export function menu(label: string, text: string, entries: () => readonly Entry[]): HTMLElement {
  const summary = element("summary", { "aria-label": label, title: label }, text);
  const list = element("div");
  const box = element("details", { class: "menu" }, summary, list);
  const close = (): void => {
    box.open = false;
  };
  box.addEventListener("toggle", () => {
    if (!box.open) return;
    list.replaceChildren(
      ...entries().map(([words, act, hint]) =>
        element(
          "button",
          {
            type: "button",
            onclick: () => {
              close();
              summary.focus();
              act();
            },
          },
          words,
          ...(hint ? [element("kbd", {}, hint)] : []),
        ),
      ),
    );
  });
  box.addEventListener("keydown", (event) => {
    if (event.key !== "Escape" || !box.open) return;
    close();
    summary.focus();
    event.stopPropagation();
  });
  const leave = (to: EventTarget | null): void => {
    if (to instanceof Node && !box.contains(to)) close();
  };
  box.addEventListener("focusout", (event) => leave(event.relatedTarget));
  document.addEventListener("pointerdown", (event) => leave(event.target));
  return box;
}
