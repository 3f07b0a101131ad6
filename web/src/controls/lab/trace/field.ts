import { element } from "../../../panel.ts";

/** A row of the form: a label, its controls, and a line for what is wrong. */
export interface Field {
  readonly root: HTMLElement;
  /** Marks a control and shows what is wrong with it; an empty text removes that. */
  complain(text: string, control?: HTMLElement): void;
}

let fields = 0;

/** The first control gets the label. */
export function field(label: string, ...controls: readonly HTMLElement[]): Field {
  const id = `trace-field-${fields++}`;
  const error = element("p", { id: `${id}-error`, class: "error", role: "alert" });
  const [first] = controls;
  first?.setAttribute("id", id);
  for (const control of controls) control.setAttribute("aria-describedby", `${id}-error`);
  return {
    root: element(
      "div",
      { class: "trace-field" },
      element("label", { for: id }, label),
      element("div", { class: "trace-controls" }, ...controls),
      error,
    ),
    complain: (text, control = first) => {
      error.textContent = text;
      for (const one of controls) {
        if (text && one === control) one.setAttribute("aria-invalid", "true");
        else one.removeAttribute("aria-invalid");
      }
    },
  };
}
