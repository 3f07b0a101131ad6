import { mm } from "../format.ts";
import { element } from "../panel.ts";
import type { SceneView } from "../wire/messages.ts";
import { type Moment, OUTSIDE } from "./moment.ts";

const QUIETEST_MS = 900;
const PHASES = ["outside", "sticking in", "sliding into", "sliding out of", "behind"] as const;

/** What the view shows in one sentence, for those who do not see it. */
export function sentence(moment: Moment, scene: SceneView): string {
  const parts = moment.membranes.flatMap(({ phase, depth }, i) => {
    const name = scene.membranes[i]?.name ?? `membrane ${i + 1}`;
    if (phase === OUTSIDE) return [];
    const words = PHASES[phase] ?? "in";
    return [`${words} ${name}${Number.isFinite(depth) ? ` at ${mm(depth / 1000, 1)}` : ""}`];
  });
  return parts.length ? `The tip is ${parts.join(", ")}.` : "The tip is outside all membranes.";
}

/** Speaks at changes of phase only, and not more than about once a second: sliding and sticking alternate fast. */
export function spoken(host: HTMLElement): (moment: Moment, scene: SceneView, now: number) => void {
  const region = element("div", { class: "only-read", "aria-live": "polite", role: "status" });
  host.append(region);
  let last = "";
  let said = 0;
  return (moment, scene, now) => {
    const key = moment.membranes.map(({ phase }) => phase).join();
    if (key === last || now - said < QUIETEST_MS) return;
    last = key;
    said = now;
    region.textContent = sentence(moment, scene);
  };
}
