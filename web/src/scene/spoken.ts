import { mm } from "../format.ts";
import { element } from "../panel.ts";
import type { SceneView } from "../wire/messages.ts";
import { type Phase, wordsOf } from "../wire/ticks.ts";
import { type Moment, OUTSIDE } from "./moment.ts";

const INTERVAL_MS = 900; // at least, between two sentences
const PHASES = wordsOf("phase");
const SPOKEN: Readonly<Record<Phase, string>> = {
  outside: "outside",
  sticking: "sticking in",
  sliding_in: "sliding into",
  sliding_out: "sliding out of",
  barred: "without force in",
};

/** The state of the needle in one sentence, for a screen reader. */
export function sentence(moment: Moment, scene: SceneView): string {
  const parts = moment.membranes.flatMap(({ phase, depth }, i) => {
    const name = scene.membranes[i]?.name ?? `membrane ${i + 1}`;
    if (phase === OUTSIDE) return [];
    const words = SPOKEN[PHASES[phase]!] ?? "in";
    return [`${words} ${name}${Number.isFinite(depth) ? ` at ${mm(depth / 1000, 1)}` : ""}`];
  });
  return parts.length ? `The tip is ${parts.join(", ")}.` : "The tip is outside all membranes.";
}

/** Speaks only when a phase changes, and at most about once per second: sliding and sticking alternate fast. */
export function spoken(host: HTMLElement): (moment: Moment, scene: SceneView, now: number) => void {
  const region = element("div", { class: "only-read", "aria-live": "polite", role: "status" });
  host.append(region);
  let last = "";
  let spokenAt = 0;
  return (moment, scene, now) => {
    const key = moment.membranes.map(({ phase }) => phase).join();
    if (key === last || now - spokenAt < INTERVAL_MS) return;
    last = key;
    spokenAt = now;
    region.textContent = sentence(moment, scene);
  };
}
