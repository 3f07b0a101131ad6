import { remember, remembered } from "../../state/remembered.ts";
import { Signal } from "../../state/signal.ts";

/** The panels that can change places, and the places: a and b above, c and d below. */
export const PANELS = ["view", "force-depth", "phases", "time-plots"] as const;
export type PanelName = (typeof PANELS)[number];
export const PLACES = ["a", "b", "c", "d"] as const;

export const TITLES: Readonly<Record<PanelName, string>> = {
  view: "View",
  "force-depth": "Force against depth",
  phases: "Membranes",
  "time-plots": "Against time",
};

/** Where the separators stand. left: share of the width without the controls; top: share of the height; side: px. */
export interface Sizes {
  readonly left: number;
  readonly top: number;
  readonly side: number;
}
export const RANGES: Readonly<Record<keyof Sizes, readonly [least: number, most: number]>> = {
  left: [0.2, 0.8],
  top: [0.25, 0.85],
  side: [280, 640],
};

/** What the browser remembers of the layout. */
export interface Arrangement extends Sizes {
  /** The panel at each place, in the order of PLACES. */
  readonly order: readonly PanelName[];
  readonly projector: boolean;
}
export const DEFAULT: Arrangement = { left: 0.535, top: 0.6, side: 344, order: PANELS, projector: false };

export const within = (name: keyof Sizes, value: number): number =>
  Math.min(RANGES[name][1], Math.max(RANGES[name][0], value));

/** The arrangement as digits and underscores, for `remember`: 535_600_344_0123_0. */
export function written({ left, top, side, order, projector }: Arrangement): string {
  const places = order.map((panel) => PANELS.indexOf(panel)).join("");
  return [Math.round(left * 1e3), Math.round(top * 1e3), Math.round(side), places, Number(projector)].join("_");
}

/** The arrangement in such a text; the default if the text is something else. */
export function parse(text: string | null): Arrangement {
  const found = /^(\d{1,4})_(\d{1,4})_(\d{1,4})_([0-3]{4})_([01])$/.exec(text ?? "");
  if (!found) return DEFAULT;
  const [, left, top, side, digits, projector] = found;
  const order = [...digits!].map((digit) => PANELS[Number(digit)]!);
  return {
    left: within("left", Number(left) / 1e3),
    top: within("top", Number(top) / 1e3),
    side: within("side", Number(side)),
    order: new Set(order).size === PANELS.length ? order : DEFAULT.order,
    projector: projector === "1",
  };
}

/** The same with two panels swapped. */
export function swapped(now: Arrangement, one: PanelName, other: PanelName): Arrangement {
  const order = now.order.map((panel) => (panel === one ? other : panel === other ? one : panel));
  return { ...now, order };
}

const KEY = "layout";

/** The arrangement of this page, and the panel that fills the page at present. */
export class Arrangements {
  readonly now: Signal<Arrangement>;
  readonly maximised = new Signal<PanelName | null>(null);

  /** jar: where it is remembered. */
  constructor(private readonly jar: Pick<Document, "cookie"> = document) {
    this.now = new Signal(parse(remembered(KEY, jar)));
  }

  set(change: Partial<Arrangement>): void {
    this.now.value = { ...this.now.value, ...change };
    remember(KEY, written(this.now.value), this.jar);
  }

  swap(one: PanelName, other: PanelName): void {
    this.set(swapped(this.now.value, one, other));
  }

  toggle(panel: PanelName): void {
    this.maximised.value = this.maximised.value === panel ? null : panel;
  }

  reset(): void {
    this.maximised.value = null;
    this.set(DEFAULT);
  }
}
