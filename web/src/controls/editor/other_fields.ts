import { element } from "../../panel.ts";
import { fieldFrame, type Input } from "./field_frame.ts";
import type { Field } from "./fields.ts";
import { numberText, parseNumber } from "./number.ts";

/** A field for one line of text. */
export function textField(field: Field, id: string, change: (value: string) => void): Input {
  const frame = fieldFrame(field, id);
  const box = element("input", { ...frame.attributes, type: "text", autocomplete: "off", class: "words" });
  box.addEventListener("change", () => change(box.value));
  frame.controls.append(box);
  return {
    root: frame.root,
    complain: frame.complain,
    show: (value) => {
      if (typeof value === "string" && value !== box.value) box.value = value;
    },
  };
}

const WORDS: Readonly<Record<string, string>> = {
  stylus: "the stylus",
  motion: "motion of the tip",
  low_pass: "low-pass",
  line_fit: "line fit",
};

/** A field for one of several options. */
export function choiceField(
  field: Field,
  id: string,
  change: (value: string | number) => void,
  label = (option: string | number): string => WORDS[option] ?? String(option),
): Input {
  const frame = fieldFrame(field, id);
  const select = element("select", { ...frame.attributes });
  for (const [index, option] of field.options.entries())
    select.append(element("option", { value: index }, label(option)));
  select.addEventListener("change", () => {
    const chosen = field.options[Number(select.value)];
    if (chosen !== undefined) change(chosen);
  });
  frame.controls.append(select);
  return {
    root: frame.root,
    complain: frame.complain,
    show: (value) => {
      select.selectedIndex = field.options.indexOf((value ?? field.standard) as string | number);
    },
  };
}

const AXES = ["x", "y", "z"] as const;

/** A field for three numbers. */
export function vectorField(field: Field, id: string, change: (value: number[]) => void): Input {
  const frame = fieldFrame(field, id);
  frame.root.querySelector("label")?.setAttribute("for", `${id}-x`);
  let shown: readonly unknown[] = [];
  const boxes = AXES.map((axis) =>
    element("input", {
      id: `${id}-${axis}`,
      type: "text",
      inputmode: "decimal",
      autocomplete: "off",
      class: "number",
      "aria-label": `${field.title} ${axis}${field.unit ? `, ${field.unit}` : ""}`,
      "aria-describedby": frame.attributes["aria-describedby"] ?? "",
    }),
  );
  const commit = (): void => {
    const values: number[] = [];
    for (const [i, box] of boxes.entries()) {
      const parsed = parseNumber(box.value);
      if ("wrong" in parsed) {
        frame.reject(`${AXES[i]}: ${parsed.wrong}`);
        return;
      }
      values.push(parsed.value);
    }
    frame.reject("");
    shown = values;
    change(values);
  };
  for (const [i, box] of boxes.entries()) {
    box.addEventListener("change", commit);
    frame.controls.append(element("span", { class: "axis", "aria-hidden": "true" }, AXES[i] ?? ""), box);
  }
  frame.controls.append(element("span", { class: "unit" }, field.unit));
  return {
    root: frame.root,
    complain: frame.complain,
    show: (value) => {
      if (!Array.isArray(value) || value.every((x, i) => Object.is(x, shown[i]))) return;
      shown = [...value];
      boxes.forEach((box, i) => {
        box.value = numberText(value[i]);
      });
      frame.reject("");
    },
  };
}
