import { element } from "../../panel.ts";
import { type Field, printed } from "./fields.ts";
import { boundText } from "./problems.ts";

/** A field on the page. */
export interface Input {
  readonly root: HTMLElement;
  /** Shows a value that came from elsewhere; what a person is typing stays where the value is the same. */
  show(value: unknown): void;
  /** Says what the engine finds wrong with the field; empty takes it away. */
  complain(text: string): void;
}

interface Frame {
  readonly root: HTMLElement;
  readonly controls: HTMLElement;
  readonly helpId: string;
  /** For the element that is labelled. */
  readonly attributes: Readonly<Record<string, string>>;
  complain(text: string): void;
  /** Says what is wrong with what was typed, which has not been sent. */
  reject(text: string): void;
}

/** What a field does, in words: its help, its bounds, why they are so. */
export function helpText(field: Field): string {
  const bounds = boundText(field);
  const unit = field.unit ? ` ${field.unit}` : "";
  return [field.help, bounds && `${bounds.charAt(0).toUpperCase()}${bounds.slice(1)}${unit}.`]
    .filter(Boolean)
    .join(" ");
}

/** Label, symbol and unit around a field, its help for whoever focuses it, and its error below it. */
export function fieldFrame(field: Field, id: string): Frame {
  const helpId = `${id}-help`;
  const errorId = `${id}-error`;
  const error = element("p", { id: errorId, class: "error", role: "alert" });
  const controls = element("div", { class: "controls" });
  const label = element("label", { for: id, title: helpText(field) }, field.title);
  if (field.symbol) label.append(" ", element("i", { class: "symbol" }, printed(field.symbol)));
  const root = element(
    "div",
    { class: `field kind-${field.kind}`, "data-help": helpText(field), "data-key": field.key },
    label,
    controls,
    element("span", { id: helpId, class: "only-read" }, helpText(field)),
    error,
  );
  let typed = "";
  let found = "";
  const tell = (): void => {
    const text = typed || found;
    if (error.textContent === text) return;
    error.textContent = text;
    for (const input of controls.querySelectorAll("[aria-describedby]:not([type=range])")) {
      if (text) input.setAttribute("aria-invalid", "true");
      else input.removeAttribute("aria-invalid");
    }
  };
  return {
    root,
    controls,
    helpId,
    attributes: { id, "aria-describedby": `${helpId} ${errorId}` },
    complain: (text) => {
      found = text;
      tell();
    },
    reject: (text) => {
      typed = text;
      tell();
    },
  };
}
