import { element } from "../../panel.ts";

/** One place for the help of the field under the pointer or focus, because there is no space for help at each field. */
export function helpLine(form: HTMLElement, standing: string): HTMLElement {
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
