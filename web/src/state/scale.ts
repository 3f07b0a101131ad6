import { newton } from "../format.ts";
import type { MembraneEvent } from "../wire/messages.ts";
import type { History } from "./history.ts";
import type { Source } from "./source.ts";

/** The names of the two forces; python/punctura/live/force_words.py has the same for the terminal. */
export const MODEL_FORCE = "model force";

/** A force scale with two decimals, or two digits if it is below 0.1: "0.30", "0.066". */
export const scaleText = (scale: number): string =>
  scale >= 0.0995 ? scale.toFixed(2) : String(Number(scale.toPrecision(2)));

/** The name of the force on the hand, with the scale if the device gives less than the model's force. */
export const feltForce = (scale: number): string => (scale === 1 ? "felt force" : `felt force (× ${scaleText(scale)})`);

/** The same for a learner: "felt force: 5.5 % of the model's". */
export const feltShareText = (scale: number): string =>
  scale === 1 ? "felt force" : `felt force: ${Number((100 * scale).toPrecision(2))} % of the ${MODEL_FORCE}`;

/** How much of the model's force the device gives, before the limits: at the shown tick, or in the scene. */
export function scaleOf(source: Source, tick: number | null = source.shown()): number {
  const shown = tick === null ? Number.NaN : (source.history.row("force_scale", tick)[0] ?? Number.NaN);
  return Number.isFinite(shown) ? shown : (source.scene.value?.force_scale ?? 1);
}

/** The size of a force in a tick, N. */
export function sizeOf(history: History, column: "force" | "model_force", tick: number): number {
  const [x, y, z] = history.row(column, tick);
  return Math.hypot(x!, y!, z!);
}

/** The felt part of the model's force in a tick, after force scale and limits: 0 while the force is off. */
export function feltShare(history: History, tick: number): number {
  const model = sizeOf(history, "model_force", tick);
  return model > 0 ? sizeOf(history, "force", tick) / model : 0;
}

const EQUAL = 1e-3; // share of the force

/**
 * The force that fell at a pop, by its tick and the one before: "force" if the hand got all of it; else, or if these
 * ticks are not kept, "model force".
 */
export function fallenForce(history: History, tick: number): "force" | typeof MODEL_FORCE {
  const felt = [tick - 1, tick].every((at) => {
    if (at < history.first || at >= history.end) return false;
    const model = sizeOf(history, "model_force", at);
    return Math.abs(sizeOf(history, "force", at) - model) <= EQUAL * model;
  });
  return felt ? "force" : MODEL_FORCE;
}

/** The drop of the felt force at a pop, N: the model's times the force scale; null if a limit cut it, or if unknown. */
export function feltDrop(history: History, { tick, drop }: MembraneEvent): number | null {
  if (tick <= history.first || tick >= history.end) return null;
  const scale = feltShare(history, tick - 1);
  const felt = [tick - 1, tick].every((at) => {
    const model = sizeOf(history, "model_force", at);
    return Math.abs(sizeOf(history, "force", at) - scale * model) <= EQUAL * model;
  });
  return scale > 0 && felt ? scale * Math.abs(drop) : null;
}

/** The drop of the model's force at a pop: "−0.79 N", or "model force −0.79 N" if the hand did not feel all of it. */
export const dropText = (history: History, { tick, drop }: MembraneEvent): string =>
  `${fallenForce(history, tick) === MODEL_FORCE ? `${MODEL_FORCE} ` : ""}−${Math.abs(drop).toFixed(2)} N`;

/** The drop at a pop for a learner: of the felt force, or "model force −0.79 N" where that is not known. */
export function feltDropText(history: History, event: MembraneEvent): string {
  const felt = feltDrop(history, event);
  return felt === null ? dropText(history, event) : `−${newton(felt)}`;
}

/** The same in a sentence: "force fell by 0.32 N", "felt force fell ..." if the hand did not get all of it. */
export function fallOf(history: History, event: MembraneEvent): string {
  const felt = feltDrop(history, event);
  const name = fallenForce(history, event.tick);
  const words = felt !== null && name === MODEL_FORCE ? "felt force" : name;
  return `${words} fell by ${newton(felt ?? Math.abs(event.drop))}`;
}
