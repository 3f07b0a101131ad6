import type { Draft } from "./draft.ts";
import type { Input } from "./field_frame.ts";
import type { Field } from "./fields.ts";
import { numberField } from "./number_field.ts";
import { numberOrWordField } from "./number_or_word_field.ts";
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
