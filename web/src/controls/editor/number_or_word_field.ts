import { element } from "../../panel.ts";
import type { Input } from "./field_frame.ts";
import type { Field } from "./fields.ts";
import { numberField } from "./number_field.ts";

/** A number field with a check box for the word that may stand in place of the number. */
export function numberOrWordField(field: Field, id: string, change: (value: number | string) => void): Input {
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
