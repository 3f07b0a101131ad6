import { element } from "../../panel.ts";
import type { Draft } from "./draft.ts";
import type { Input } from "./field_frame.ts";
import type { Field } from "./fields.ts";
import { numberField } from "./number_field.ts";
import { numbersField } from "./numbers_field.ts";
import { choiceField, textField, vectorField } from "./other_fields.ts";
import { type Path, pathText } from "./tables.ts";

/** Numbers that are set once, so a slider is no help. */
const NO_SLIDER = new Set(["rate_hz", "encoder_step_mm", "sub_steps"]);

const idOf = (path: Path): string => `scene-${pathText(path).replace(/[[\].]+/g, "-")}`;

/** The input of one field. It writes its value to the draft. */
export function single(field: Field, path: Path, draft: Draft): Input {
  const change = (value: unknown): void => draft.set(path, value);
  switch (field.kind) {
    case "text":
      return textField(field, idOf(path), change);
    case "choice":
      return choiceField(field, idOf(path), change, field.sizes.length ? sized(field) : undefined);
    case "vector":
      return vectorField(field, idOf(path), change);
    case "numbers":
      return numbersField(field, idOf(path), change);
    default:
      if (field.word) return numberOrWordField(field, idOf(path), change);
      return numberField(field, idOf(path), !NO_SLIDER.has(field.key), change);
  }
}

const sized =
  (field: Field) =>
  (option: string | number): string =>
    `${option} G, ${field.sizes[field.options.indexOf(option)]} mm`;

/** A number field with a check box for the word that may stand in place of the number. */
function numberOrWordField(field: Field, id: string, change: (value: number | string) => void): Input {
  let number = typeof field.standard === "number" ? field.standard : 1;
  const input = numberField(field, id, true, (value) => {
    number = value;
    change(value);
  });
  const box = element("input", { type: "checkbox", id: `${id}-word` });
  box.addEventListener("change", () => change(box.checked ? field.word : number));
  input.root.append(element("label", { class: "or-word", for: `${id}-word` }, box, field.word));
  const inputs = input.root.querySelectorAll<HTMLInputElement>("input:not([type=checkbox])");
  return {
    ...input,
    show: (value = field.standard) => {
      box.checked = value === field.word;
      for (const each of inputs) each.disabled = box.checked;
      if (typeof value === "number") number = value;
      input.show(number);
    },
  };
}
