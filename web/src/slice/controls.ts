import { button, element } from "../panel.ts";
import { type Probe, type ProbePlace, wrapped } from "../scene/probe.ts";

/** Pixels of the tissue's picture at each level, before it is scaled up. */
const LEVELS = [40_000, 22_000, 12_000] as const;

const SLOW_MS = 10; // a third of the time of a picture at 30 a second: the 3-D view needs the rest
const FAST_MS = 3.5;
const PATIENCE = 12; // pictures

/** Lowers the number of pixels while pictures take too long, and raises it again. */
export class Quality {
  level = 0;
  private slow = 0;
  private fast = 0;

  get pixels(): number {
    return LEVELS[this.level]!;
  }

  /** took: ms for the last picture. Returns whether the level changed. */
  judge(took: number): boolean {
    this.slow = took > SLOW_MS ? this.slow + 1 : Math.max(0, this.slow - 1);
    this.fast = took < FAST_MS ? this.fast + 1 : 0;
    if (this.slow >= PATIENCE && this.level < LEVELS.length - 1) this.level++;
    else if (this.fast >= 10 * PATIENCE && this.level > 0) this.level--;
    else return false;
    this.slow = 0;
    this.fast = 0;
    return true;
  }
}

const REACH_MM = 25;
const DEGREE = Math.PI / 180;

const clamp = (value: number, most: number): number => Math.max(-most, Math.min(most, value));

/** Moves the probe in its own directions: along the picture and out of it, mm, and by a turn in radians. */
export function moved(place: ProbePlace, along: number, out: number, turn = 0): ProbePlace {
  const [c, s] = [Math.cos(place.turn), Math.sin(place.turn)];
  return {
    x: clamp(place.x + c * along - s * out, REACH_MM),
    z: clamp(place.z + s * along + c * out, REACH_MM),
    turn: wrapped(place.turn + turn),
  };
}

export const PROBE_KEYS =
  "Drag the picture, or use the arrow keys on it, to move the probe. Q and E turn it, Home puts it along the needle; " +
  "Shift moves it farther.";

/** Keys on the picture. */
const KEYS: Readonly<Record<string, readonly [along: number, out: number, degrees: number]>> = {
  ArrowLeft: [-0.5, 0, 0],
  ArrowRight: [0.5, 0, 0],
  ArrowUp: [0, -0.5, 0],
  ArrowDown: [0, 0.5, 0],
  q: [0, 0, -5],
  e: [0, 0, 5],
};

export function probeKeys(canvas: HTMLElement, probe: Probe, toNeedle: () => void): void {
  canvas.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    const step = KEYS[key];
    if (step) {
      const far = event.shiftKey ? 4 : 1;
      probe.place.value = moved(probe.place.value, far * step[0], far * step[1], step[2] * DEGREE);
    } else if (key === "Home") toNeedle();
    else return;
    event.preventDefault();
  });
}

/** A drag on the picture moves the probe; mmPerPixel: of the picture. */
export function probeDrag(canvas: HTMLElement, probe: Probe, mmPerPixel: () => number): void {
  let held: { id: number; x: number; y: number } | null = null;
  canvas.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    held = { id: event.pointerId, x: event.clientX, y: event.clientY };
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener("pointermove", (event) => {
    if (held?.id !== event.pointerId) return;
    const scale = mmPerPixel();
    const [along, out] = [(event.clientX - held.x) * scale, (event.clientY - held.y) * scale];
    held = { id: held.id, x: event.clientX, y: event.clientY };
    probe.place.value = moved(probe.place.value, -along, out);
  });
  for (const name of ["pointerup", "pointercancel"] as const) {
    canvas.addEventListener(name, () => {
      held = null;
    });
  }
}

/** Buttons over the picture: two places of the probe, and close. */
export function probeButtons(toNeedle: (across: boolean) => void, close: () => void): HTMLElement {
  return element(
    "div",
    { class: "view-tools slice-tools", role: "toolbar", "aria-label": "Slice" },
    button("Along needle", "Place the probe so that the needle lies in the slice", () => toNeedle(false)),
    button("Across needle", "Place the probe so that the needle crosses the slice", () => toNeedle(true)),
    button("×", "Close the slice", close),
  );
}

/** Sliders for the probe's place and turn. */
export function probeSliders(probe: Probe): HTMLElement {
  const slider = (
    name: string,
    unit: string,
    most: number,
    step: number,
    read: (place: ProbePlace) => number,
    write: (place: ProbePlace, value: number) => ProbePlace,
  ): HTMLElement => {
    const input = element("input", { type: "range", min: -most, max: most, step });
    const value = element("output");
    input.addEventListener("input", () => {
      probe.place.value = write(probe.place.value, Number(input.value));
    });
    probe.place.watch((place) => {
      input.value = String(read(place));
      value.textContent = `${read(place).toFixed(step < 1 ? 1 : 0)} ${unit}`;
      input.setAttribute("aria-valuetext", value.textContent);
    });
    return element("label", {}, element("span", {}, name), input, value);
  };
  return element(
    "details",
    { class: "slice-probe" },
    element("summary", {}, "Move the probe"),
    slider("Left–right", "mm", REACH_MM, 0.5, (at) => at.x, (at, x) => ({ ...at, x })),
    slider("Back–front", "mm", REACH_MM, 0.5, (at) => at.z, (at, z) => ({ ...at, z })),
    slider("Turn", "degrees", 90, 1, (at) => at.turn / DEGREE, (at, turn) => ({ ...at, turn: turn * DEGREE })),
    element("p", {}, PROBE_KEYS),
  ); // biome-ignore format: a list
}
