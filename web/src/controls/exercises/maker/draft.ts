import type { SceneOutline } from "../../../wire/messages.ts";
import { layersOf } from "../trace.ts";

/** The fields with which the form asks for goals, from the JSON Schema of exercise files. */

/** One kind of goal that the form can ask for. */
export interface GoalField {
  readonly kind: string;
  /** The key of the goal's table that the field fills. */
  readonly key: string;
  readonly label: string;
  /** The key is the name of a membrane; else it is a number. */
  readonly membrane: boolean;
  /** The goal also names the membrane in front of the space. */
  readonly atSpace: boolean;
  readonly needsSyringe: boolean;
}

interface Property {
  readonly type?: string;
  readonly const?: string;
  readonly "x-label"?: string;
}
export interface ExerciseSchema {
  readonly properties: { readonly goal: { readonly items: { readonly oneOf: readonly { readonly $ref: string }[] } } };
  readonly $defs: Readonly<
    Record<string, { readonly properties: Readonly<Record<string, Property>>; readonly "x-syringe"?: boolean }>
  >;
}

export function goalFields({ properties, $defs }: ExerciseSchema): GoalField[] {
  return properties.goal.items.oneOf.flatMap(({ $ref }) => {
    const goal = $defs[$ref.replace("#/$defs/", "")]!;
    return Object.entries(goal.properties).flatMap(([key, { type, "x-label": label }]) =>
      label
        ? {
            kind: goal.properties.kind!.const!,
            key,
            label,
            membrane: type === "string",
            atSpace: "membrane" in goal.properties && key !== "membrane",
            needsSyringe: goal["x-syringe"] === true,
          }
        : [],
    );
  });
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
  readonly blind: boolean;
  /** The number, or the membrane, of each goal that is asked for, by its kind. */
  readonly goals: Readonly<Record<string, number | string>>;
}
export type FieldName = Exclude<keyof Draft, "goals"> | `goal.${string}`;

const LEAST_ROOM = 0.2; // mm
const HEIGHT = 5; // mm in front of the surface, where the needle waits

const TO_A_VESSEL = 30; // degrees to the skin, as the scene begins; upright, the tip is longer than a vein is wide

/** The draft of a scene: behind this membrane, or else behind its last but one, or its only one. */
export function draftOf(scene: SceneOutline, name = ""): Draft {
  const { membranes } = scene;
  const behind = membranes.find((one) => one.name === name) ?? membranes[Math.max(0, membranes.length - 2)]!;
  const vessel = behind.behind === "blood";
  const at = scene.membranes.indexOf(behind);
  const [layer, next] = layersOf(scene.membranes).slice(at);
  const between = next ? round((next.top - layer!.bottom) * 1e3) : null;
  const touches = between !== null && between <= LEAST_ROOM; // then the space is the next layer
  const room = touches ? round((next!.bottom - next!.top) * 1e3) : between;
  const draft: Omit<Draft, "instruction"> = {
    title: "My exercise",
    scene: scene.name,
    space: SPACES[behind.behind] ?? (touches ? `the ${next!.name}` : `the space behind the ${behind.name}`),
    behind: behind.name,
    from: 0,
    to: room !== null && room > LEAST_ROOM ? room : 8,
    angle: membranes.some((one) => one.behind === "blood") ? TO_A_VESSEL : 90,
    wholeTip: vessel,
    blind: false,
    goals: { stay: 2, entries: 3, time_limit: 60 },
  };
  return { ...draft, instruction: taskOf(draft) };
}

/** The task's sentence. */
function taskOf({ behind, from, angle, goals }: Omit<Draft, "instruction">): string {
  const push = `Push in${angle === 90 ? "" : ` at ${angle} degrees`}`;
  const plunger = "feel_plunger" in goals || "stop_plunger" in goals;
  const until = plunger ? "and push the plunger until it gives way behind" : "until";
  const gives = plunger ? "" : " gives way";
  const end = from > 0 ? `, go on for ${from} mm, and stop.` : ", and stop.";
  return `${push} ${until} the ${behind}${gives}${end}`;
}

const SPACES: Readonly<Record<string, string>> = { blood: "the vessel", "epidural space": "the epidural space" };

/** A draft after a change. What the teacher has not edited follows the scene and the goal. */
export function changed(
  draft: Draft,
  part: Partial<Draft>,
  scene: SceneOutline,
  edited: ReadonlySet<FieldName>,
): Draft {
  const followed = (next: Draft): Draft => (edited.has("instruction") ? next : { ...next, instruction: taskOf(next) });
  if (part.scene === undefined && part.behind === undefined) return followed({ ...draft, ...part });
  const fresh = draftOf(scene, part.behind);
  const kept = (Object.keys(fresh) as (keyof Draft)[]).filter((key) => edited.has(key as FieldName));
  // A goal that names a membrane of another scene cannot be kept.
  const goals = part.scene === undefined ? draft.goals : fresh.goals;
  return followed({ ...fresh, ...Object.fromEntries(kept.map((key) => [key, draft[key]])), goals });
}

export const round = (mm: number): number => Math.round(mm * 10) / 10;

/** The tables of an exercise file. Without a goal that asks for a stay, the draft asks to reach the space. */
export function tablesOf(draft: Draft, scene: SceneOutline, fields: readonly GoalField[]): Record<string, unknown> {
  const whole = draft.wholeTip ? { whole_tip: true } : {};
  const goals: Record<string, unknown>[] = "stay" in draft.goals ? [] : [{ kind: "reach", ...whole }];
  for (const { kind, key, atSpace } of fields) {
    if (!(kind in draft.goals)) continue;
    const more = { ...(atSpace && { membrane: draft.behind }), ...(kind === "stay" && whole) };
    goals.push({ kind, [key]: draft.goals[kind], ...more });
  }
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
export function fieldOf(path: string, tables: Record<string, unknown>): FieldName | "" {
  const goal = /^goal\[(\d+)\]/.exec(path);
  if (!goal) return FIELDS[path] ?? "";
  const kind = (tables.goal as { kind: string }[])[Number(goal[1])]?.kind ?? "";
  return kind === "reach" ? "wholeTip" : `goal.${kind}`;
}

const FIELDS: Readonly<Record<string, FieldName>> = {
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
