import type { MembraneView } from "../../../wire/messages.ts";
import { layersOf } from "../trace.ts";

/** A ready scene for the making of an exercise: one entry of `GET /api/scenes`. SI. */
export interface SceneOutline {
  readonly name: string;
  readonly title: string;
  readonly tip_length: number;
  readonly membranes: readonly MembraneView[];
  /** The needle has a syringe with a plunger. */
  readonly syringe: boolean;
}

/** What the form holds. Lengths in mm; null: not wanted. */
export interface Draft {
  readonly title: string;
  readonly instruction: string;
  readonly scene: string;
  readonly space: string;
  readonly behind: string;
  readonly from: number;
  readonly to: number | null;
  readonly angle: number;
  readonly wholeTip: boolean;
  readonly stay: number | null;
  readonly stopWithin: number | null;
  /** N, with which the thumb pushes the plunger until it gives way. */
  readonly push: number | null;
  /** mL, in the second after the plunger gives way. */
  readonly inject: number | null;
  readonly neverPass: string;
  readonly peakForce: number | null;
  readonly entries: number | null;
  /** Degrees, by which the angle of an entry may differ from `angle`. */
  readonly angleWithin: number | null;
  /** mm/s. */
  readonly speed: number | null;
  /** s, for which the needle may stand still on the way. */
  readonly pause: number | null;
  /** mm behind the membrane. */
  readonly depth: number | null;
  readonly seconds: number | null;
  readonly blind: boolean;
}

const HEIGHT = 5; // mm in front of the surface, where the needle waits

/** The draft of a scene: behind its last membrane but one, or its only one. */
export function draftOf(scene: SceneOutline): Draft {
  const behind = scene.membranes[Math.max(0, scene.membranes.length - 2)]!;
  const next = scene.membranes[scene.membranes.indexOf(behind) + 1];
  const layers = layersOf(scene.membranes);
  const at = scene.membranes.indexOf(behind);
  const room = next ? round((layers[at + 1]!.top - layers[at]!.bottom) * 1e3) : null;
  return {
    title: "My exercise",
    instruction: `Push in until the ${behind.name} gives way, and stop.`,
    scene: scene.name,
    space: `the space behind the ${behind.name}`,
    behind: behind.name,
    from: 0,
    to: room !== null && room > 0.2 ? room : 8,
    angle: 90,
    wholeTip: false,
    stay: 2,
    stopWithin: null,
    push: null,
    inject: null,
    neverPass: "",
    peakForce: null,
    entries: 3,
    angleWithin: null,
    speed: null,
    pause: null,
    depth: null,
    seconds: 60,
    blind: false,
  };
}

export const round = (mm: number): number => Math.round(mm * 10) / 10;

/** The tables of an exercise file. Without a goal that asks for a stay, the draft asks to reach the space. */
export function tablesOf(draft: Draft, scene: SceneOutline): Record<string, unknown> {
  const whole = draft.wholeTip ? { whole_tip: true } : {};
  const goals: Record<string, unknown>[] = [];
  if (draft.stay === null) goals.push({ kind: "reach", ...whole });
  else goals.push({ kind: "stay", seconds: draft.stay, ...whole });
  if (draft.stopWithin !== null)
    goals.push({ kind: "stop_after_pop", membrane: draft.behind, within_mm: draft.stopWithin });
  if (draft.push !== null) goals.push({ kind: "feel_plunger", at_least_N: draft.push });
  if (draft.inject !== null) goals.push({ kind: "stop_plunger", within_mL: draft.inject });
  if (draft.neverPass) goals.push({ kind: "never_pass", membrane: draft.neverPass });
  if (draft.peakForce !== null) goals.push({ kind: "peak_force", at_most_N: draft.peakForce });
  if (draft.entries !== null) goals.push({ kind: "entries", at_most: draft.entries });
  if (draft.angleWithin !== null) goals.push({ kind: "entry_angle", within_deg: draft.angleWithin });
  if (draft.speed !== null) goals.push({ kind: "speed", at_most_mm_per_s: draft.speed });
  if (draft.pause !== null) goals.push({ kind: "no_pause", seconds: draft.pause });
  if (draft.depth !== null) goals.push({ kind: "depth", at_most_mm: draft.depth });
  if (draft.seconds !== null) goals.push({ kind: "time_limit", seconds: draft.seconds });
  return {
    title: draft.title,
    description: draft.instruction,
    instruction: draft.instruction,
    scene: draft.scene,
    ...(draft.blind ? { blind: true } : {}),
    start: { position_mm: startOf(draft, scene), angle_deg: draft.angle, heading: [1, 0, 0] },
    space: {
      name: draft.space,
      behind: draft.behind,
      depth_mm: draft.from,
      ...(draft.to === null ? {} : { deepest_mm: draft.to }),
    },
    goal: goals,
  };
}

/** The start, mm: the needle points at the middle of the space below the first membrane's point. */
function startOf(draft: Draft, { membranes }: SceneOutline): number[] {
  const first = membranes[0]!;
  const layers = layersOf(membranes);
  const face = (layers.find(({ name }) => name === draft.behind)?.bottom ?? 0) * 1e3;
  const middle = face + (draft.from + (draft.to ?? draft.from + 3)) / 2;
  const aside = draft.angle < 90 ? (HEIGHT + middle) / Math.tan((draft.angle * Math.PI) / 180) : 0;
  const [x, y, z] = first.point.map((value, i) => value * 1e3 - HEIGHT * first.inward_normal[i]!);
  return [round(x! - aside), round(y!), round(z!)];
}

/** The field of the form to which a problem of the file belongs; "" for the whole form. */
export function fieldOf(path: string, tables: Record<string, unknown>): keyof Draft | "" {
  const goal = /^goal\[(\d+)\]/.exec(path);
  if (goal) {
    const kind = (tables.goal as { kind: string }[])[Number(goal[1])]?.kind ?? "";
    return GOALS[kind] ?? "";
  }
  return FIELDS[path] ?? "";
}

const FIELDS: Readonly<Record<string, keyof Draft>> = {
  title: "title",
  instruction: "instruction",
  description: "instruction",
  scene: "scene",
  "space.name": "space",
  "space.behind": "behind",
  "space.depth_mm": "from",
  "space.deepest_mm": "to",
  "start.angle_deg": "angle",
  "start.position_mm": "angle",
};
const GOALS: Readonly<Record<string, keyof Draft>> = {
  reach: "wholeTip",
  stay: "stay",
  stop_after_pop: "stopWithin",
  feel_plunger: "push",
  stop_plunger: "inject",
  never_pass: "neverPass",
  peak_force: "peakForce",
  entries: "entries",
  entry_angle: "angleWithin",
  speed: "speed",
  no_pause: "pause",
  depth: "depth",
  time_limit: "seconds",
};

/** A file name made from a title: lower case letters of any script, digits and hyphens; "exercise" without any. */
export const nameOf = (title: string): string =>
  title
    .normalize("NFKD")
    .replace(/[\u0300-\u036f]/g, "") // the accents of Latin, Greek and Cyrillic letters
    .normalize("NFC")
    .toLowerCase()
    .replace(/[^\p{L}\p{M}\p{N}]+/gu, "-")
    .slice(0, 60)
    .replace(/^-+|-+$/g, "") || "exercise";
