import { element } from "../../panel.ts";
import { fieldFrame, type Input } from "./field_frame.ts";
import type { Field } from "./fields.ts";
import { nudged, numberText, parseNumber } from "./number.ts";
import { boundProblem, boundText } from "./problems.ts";
import { placeOf, type Range, rangeAround, SLIDER_STEPS, valueAt, within } from "./range.ts";

/** A number field: a slider that takes effect during the drag, and a box for the exact value. */
export function numberField(field: Field, id: string, slider: boolean, change: (value: number) => void): Input {
  const frame = fieldFrame(field, id);
  const box = element("input", {
    ...frame.attributes,
    type: "text",
    inputmode: "decimal",
    autocomplete: "off",
    spellcheck: "false",
    class: "number",
  });
  const track = element("input", {
    type: "range",
    min: 0,
    max: SLIDER_STEPS,
    step: 1,
    class: "slider",
    "aria-label": `${field.title}${field.unit ? `, ${field.unit}` : ""}`,
    "aria-describedby": frame.helpId,
  });
  let value = Number.NaN;
  let range: Range | null = null;

  const showSlider = (): void => {
    if (!range || !within(range, value)) range = rangeAround(field, value);
    track.value = String(placeOf(range, value));
    track.setAttribute("aria-valuetext", `${numberText(value)} ${field.unit}`.trim());
  };
  const commit = (): void => {
    const parsed = parseNumber(box.value, field.kind === "integer");
    const wrong = "wrong" in parsed ? parsed.wrong : boundProblem(field, parsed.value);
    frame.reject(wrong ?? "");
    if (wrong !== null || "wrong" in parsed) return;
    value = parsed.value;
    box.value = numberText(value);
    showSlider();
    change(value);
  };
  box.addEventListener("change", commit);
  box.addEventListener("keydown", (event) => {
    const direction = { ArrowUp: 1, ArrowDown: -1 }[event.key] as 1 | -1 | undefined;
    const parsed = parseNumber(box.value);
    if (!direction || "wrong" in parsed) return;
    event.preventDefault();
    box.value = numberText(nudged(parsed.value, direction));
    commit();
  });
  track.addEventListener("input", () => {
    range ??= rangeAround(field, value);
    value = valueAt(range, Number(track.value), field);
    box.value = numberText(value);
    track.setAttribute("aria-valuetext", `${numberText(value)} ${field.unit}`.trim());
    frame.reject("");
    change(value);
  });
  // After a drag to one end, the slider gets a new range around the value.
  track.addEventListener("change", () => {
    const place = Number(track.value);
    if (place === 0 || place === SLIDER_STEPS) range = rangeAround(field, value);
    showSlider();
  });

  frame.controls.append(
    ...(slider ? [] : [element("span", { class: "bounds" }, boundText(field))]),
    box,
    element("span", { class: "unit" }, field.unit),
    ...(slider ? [track] : []),
  );
  frame.root.classList.toggle("slides", slider);
  return {
    root: frame.root,
    complain: frame.complain,
    show: (next) => {
      if (typeof next !== "number" || Object.is(next, value)) return;
      value = next;
      box.value = numberText(next);
      frame.reject("");
      if (slider) showSlider();
    },
  };
}
