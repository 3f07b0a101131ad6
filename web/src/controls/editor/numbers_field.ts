import { element } from "../../panel.ts";
import { fieldFrame, type Input } from "./field_frame.ts";
import type { Field } from "./fields.ts";
import { numberText, parseNumber } from "./number.ts";

/** A field for a list of numbers of any length, separated by spaces or semicolons. */
export function numbersField(field: Field, id: string, change: (value: number[]) => void): Input {
  const frame = fieldFrame(field, id);
  const box = element("input", {
    ...frame.attributes,
    type: "text",
    autocomplete: "off",
    class: "words",
    placeholder: "none",
  });
  let shown: readonly unknown[] = [];
  box.addEventListener("change", () => {
    const parsed = parseNumbers(box.value);
    frame.reject("wrong" in parsed ? parsed.wrong : "");
    if ("wrong" in parsed) return;
    shown = parsed.values;
    change(parsed.values);
  });
  frame.controls.append(box, element("span", { class: "unit" }, field.unit));
  return {
    root: frame.root,
    complain: frame.complain,
    show: (value) => {
      const list: readonly unknown[] = Array.isArray(value) ? value : [];
      if (list.length === shown.length && list.every((x, i) => Object.is(x, shown[i]))) return;
      shown = [...list];
      box.value = list.map(numberText).join("; ");
      frame.reject("");
    },
  };
}

/** The numbers in a text, or a sentence that tells what is wrong with it. No text is an empty list. */
export function parseNumbers(text: string): { values: number[] } | { wrong: string } {
  const values: number[] = [];
  for (const part of text.split(/[\s;]+/).filter(Boolean)) {
    const parsed = parseNumber(part.replace(/,$/, ""));
    if ("wrong" in parsed) return { wrong: `${parsed.wrong} Put a space or a semicolon between two numbers.` };
    values.push(parsed.value);
  }
  return { values };
}
