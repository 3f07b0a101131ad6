import { element } from "../../panel.ts";
import { type Field, printed } from "./fields.ts";
import { boundText } from "./problems.ts";

/** An input field of the form. */
export interface Input {
  readonly root: HTMLElement;
  /** Shows a value from the draft. If the value is unchanged, text that the user is typing stays. */
  show(value: unknown): void;
  /** Shows the server's problem with the field; an empty text removes it. */
  complain(text: string): void;
}

interface Frame {
  readonly root: HTMLElement;
  readonly controls: HTMLElement;
  readonly helpId: string;
  /** Attributes of the labelled element. */
  readonly attributes: Readonly<Record<string, string>>;
  complain(text: string): void;
  /** Shows what is wrong with the typed text, which was not sent. */
  reject(text: string): void;
}

/** The help of a field, with its bounds. */
function helpText(field: Field): string {
  const bounds = boundText(field);
  const unit = field.unit ? ` ${field.unit}` : "";
  return [field.help, bounds && `${bounds.charAt(0).toUpperCase()}${bounds.slice(1)}${unit}.`]
    .filter(Boolean)
    .join(" ");
}

/** The frame of a field: label, symbol, help and error. */
export function fieldFrame(field: Field, id: string): Frame {
  const helpId = `${id}-help`;
  const errorId = `${id}-error`;
  const error = element("p", { id: errorId, class: "error", role: "alert" });
  const controls = element("div", { class: "controls" });
  const label = element("label", { for: id, title: helpText(field) }, field.title);
  if (field.symbol) {
    const { letter, index } = printed(field.symbol);
    label.append(" ", element("i", { class: "symbol" }, letter, ...(index ? [element("sub", {}, index)] : [])));
  }
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
  const show = (): void => {
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
      show();
    },
    reject: (text) => {
      typed = text;
      show();
    },
  };
}
