import { element } from "../../panel.ts";
import type { Draft } from "./draft.ts";
import type { Input } from "./field_frame.ts";
import type { Field } from "./fields.ts";
import { rounded } from "./number.ts";
import { single } from "./single.ts";
import { getAt, type Path, replaceKey, setAt, type Tables } from "./tables.ts";

const unitWords = (field: Field): string => field.unit || field.title.toLowerCase();

/** A pair of keys of which the file holds exactly one, such as a diameter in mm or as a gauge. */
export function pairField(one: Field, other: Field, path: Path, draft: Draft): Input {
  const fields = [one, other] as const;
  const inputs = fields.map((field) => single(field, [...path, field.key], draft));
  const root = element("div", { class: "pair" }, ...inputs.map((input) => input.root));
  let active = 0;

  const choose = (next: number): void => {
    const [from, to] = [fields[active]!, fields[next]!];
    const table = draft.at(path) as Tables;
    const value = converted(from, to, table[from.key]);
    if (next === active || value === undefined) return;
    draft.change(setAt(draft.tables.value, path, replaceKey(table, from.key, to.key, value)));
    root.querySelector<HTMLElement>(".field:not([hidden]) select.in")?.focus();
  };
  // The unit of each field is a list that switches between the two keys.
  for (const [index, input] of inputs.entries()) {
    const select = element("select", { class: "in", "aria-label": `${one.title} given in` });
    fields.forEach((field, i) => {
      select.append(element("option", { value: i, selected: i === index }, unitWords(field)));
    });
    select.addEventListener("change", () => {
      const next = Number(select.value);
      select.selectedIndex = index;
      choose(next);
    });
    const controls = input.root.querySelector(".controls");
    controls?.querySelector(".unit")?.remove();
    controls?.append(select);
  }
  return {
    root,
    complain: (text) => inputs[active]?.complain(text),
    show: () => {
      const table = (getAt(draft.tables.value, path) ?? {}) as Tables;
      active = other.key in table ? 1 : 0;
      inputs.forEach((input, i) => {
        input.root.hidden = i !== active;
        if (i === active) input.show(table[fields[i]!.key]);
        else input.complain("");
      });
    },
  };
}

const RAD_PER_DEG = Math.PI / 180;

/** Converts a value from one key of a pair to the other; undefined if there is no conversion. */
export function converted(from: Field, to: Field, value: unknown): number | undefined {
  if (typeof value !== "number") return undefined;
  if (from.unit === "rad" && to.unit === "degrees") return rounded(value / RAD_PER_DEG, 5);
  if (from.unit === "degrees" && to.unit === "rad") return rounded(value * RAD_PER_DEG, 5);
  if (from.sizes.length) return from.sizes[from.options.indexOf(value)];
  if (to.sizes.length) return to.options[nearest(to.sizes, value)] as number | undefined;
  return undefined;
}

function nearest(sizes: readonly number[], value: number): number {
  let best = 0;
  sizes.forEach((size, i) => {
    if (Math.abs(size - value) < Math.abs(sizes[best]! - value)) best = i;
  });
  return best;
}
