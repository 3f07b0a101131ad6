import type { ColumnPart, FileLine, RolePart, SceneView } from "../../../wire/messages.ts";
import { parseNumber } from "../../editor/number.ts";
import type { Answers } from "./job.ts";

/** The words in the fields of the form, as the user has chosen or typed them. */
export interface Typed {
  readonly columns: Readonly<Record<string, string>>;
  readonly units: Readonly<Record<string, string>>;
  readonly digitised: boolean;
  readonly diameter: string;
  readonly angle: string;
  readonly membranes: string;
}

export type Complaints = Readonly<Record<string, string>>;

/** A column with its first numbers, so that a column without a telling name can be known. */
export function columnWords({ name, examples }: ColumnPart): string {
  const numbers = examples.map((value) => String(Number(value.toPrecision(3))).replace("-", "−"));
  return numbers.length ? `${name}: ${numbers.join(", ")} …` : name;
}

/** The unit that a column's name states for this role; empty if the user must state it. */
export function statedUnit(file: Pick<FileLine, "columns">, role: RolePart, column: string): string {
  const unit = file.columns.find(({ name }) => name === column)?.unit ?? "";
  return role.units.includes(unit) ? unit : "";
}

const round = (value: number): string => String(Number(value.toPrecision(6)));

/** Diameter, mm, and tip angle, degrees, as the words of the fields. */
export function needleWords(diameter: number, angle: number): { diameter: string; angle: string } {
  return { diameter: round(1e3 * diameter), angle: round((180 / Math.PI) * angle) };
}

/** The needle of a scene: K06 (5), tan(theta) = w / X. */
export const sceneNeedle = ({ diameter, tip_length }: Pick<SceneView, "diameter" | "tip_length">) =>
  needleWords(diameter, Math.atan(diameter / tip_length));

/** The answers in a form, or what is missing by the name of its field. */
export function answersOf(file: Pick<FileLine, "roles">, typed: Typed): Answers | Complaints {
  const wrong: Record<string, string> = {};
  const units: Record<string, string> = {};
  for (const { role, needed } of file.roles) {
    const column = typed.columns[role] ?? "";
    if (!column && needed) wrong[`column.${role}`] = `Choose the column of the ${role}.`;
    if (!column) continue;
    const unit = typed.units[role] ?? "";
    if (unit) units[role] = unit;
    else wrong[`unit.${role}`] = `Choose the unit of the ${role}: the file does not state it.`;
  }
  const number = (name: string, text: string): number => {
    const parsed = parseNumber(text);
    if ("wrong" in parsed) wrong[name] = parsed.wrong;
    return "value" in parsed ? parsed.value : Number.NaN;
  };
  const diameter = number("diameter_mm", typed.diameter);
  const angle = number("tip_angle_deg", typed.angle);
  if (Object.keys(wrong).length) return wrong;
  const columns = Object.fromEntries(file.roles.map(({ role }) => [role, typed.columns[role] ?? ""]));
  const order = typed.digitised ? "depth" : "recorded";
  return { columns, units, order, diameter, angle, membranes: typed.membranes };
}

export const isComplaints = (found: Answers | Complaints): found is Complaints => !("order" in found);
