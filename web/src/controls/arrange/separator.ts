import { element } from "../../panel.ts";
import { type Arrangements, DEFAULT, RANGES, type Sizes, within } from "./arrangement.ts";

const STEPS = 50; // arrow keys from one end to the other

/** The value of a size at a place of the pointer. Given the box of all panels and the pointer, CSS pixels. */
export type Measure = (box: DOMRect, x: number, y: number) => number;

/** A line between panels. Drag it, or use the arrow keys, Home and End; a double click resets it. */
export function separator(
  all: Arrangements,
  name: keyof Sizes,
  label: string,
  measure: Measure,
  /** 1 if the value grows to the right or downwards. */
  sign: 1 | -1,
): HTMLElement {
  const flat = name === "top";
  const [least, most] = RANGES[name];
  const line = element("div", {
    class: `separator along-${name}`,
    role: "separator",
    tabindex: 0,
    "aria-label": label,
    "aria-orientation": flat ? "horizontal" : "vertical",
    "aria-valuemin": 0,
    "aria-valuemax": 100,
    title: `${label}: drag it, or use the arrow keys. A double click resets it.`,
  });
  const set = (value: number): void => all.set({ [name]: within(name, value) });
  all.now.watch((now) =>
    line.setAttribute("aria-valuenow", String(Math.round((100 * (now[name] - least)) / (most - least)))),
  );
  line.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    line.setPointerCapture(event.pointerId);
    event.preventDefault();
    line.focus();
  });
  line.addEventListener("pointermove", (event) => {
    if (!line.hasPointerCapture(event.pointerId)) return;
    set(measure(line.parentElement!.getBoundingClientRect(), event.clientX, event.clientY));
  });
  line.addEventListener("dblclick", () => set(DEFAULT[name]));
  line.addEventListener("keydown", (event) => {
    const step = (sign * (most - least)) / STEPS;
    const [less, more] = flat ? ["ArrowUp", "ArrowDown"] : ["ArrowLeft", "ArrowRight"];
    const now = all.now.value[name];
    const to = { [less!]: now - step, [more!]: now + step, Home: least, End: most }[event.key];
    if (to === undefined) return;
    event.preventDefault();
    set(to);
  });
  return line;
}
