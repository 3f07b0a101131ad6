import { button, element } from "../../../panel.ts";
import type { App } from "../../../state/app.ts";
import type { FileLine, RolePart } from "../../../wire/messages.ts";
import { answersOf, columnWords, isComplaints, needleWords, sceneNeedle, statedUnit } from "./asked.ts";
import type { Answers } from "./job.ts";

/** A row of the form: a label, its controls, and a line for what is wrong. */
interface Field {
  readonly root: HTMLElement;
  /** Marks a control and shows what is wrong with it; an empty text removes that. */
  complain(text: string, control?: HTMLElement): void;
}

let fields = 0;

/** The first control gets the label. */
function field(label: string, ...controls: readonly HTMLElement[]): Field {
  const id = `trace-field-${fields++}`;
  const error = element("p", { id: `${id}-error`, class: "error", role: "alert" });
  const [first] = controls;
  first?.setAttribute("id", id);
  for (const control of controls) control.setAttribute("aria-describedby", `${id}-error`);
  return {
    root: element(
      "div",
      { class: "trace-field" },
      element("label", { for: id }, label),
      element("div", { class: "trace-controls" }, ...controls),
      error,
    ),
    complain: (text, control = first) => {
      error.textContent = text;
      for (const one of controls) {
        if (text && one === control) one.setAttribute("aria-invalid", "true");
        else one.removeAttribute("aria-invalid");
      }
    },
  };
}

const MOST_MEMBRANES = 6; // that are offered

/** A form with what must be known of a file. What the file states is filled in; nothing is guessed. */
export interface Form {
  readonly root: HTMLElement;
  /** Shows what the studio says of a field. False if the form has no such field. */
  complain(name: string, text: string): boolean;
  lock(locked: boolean): void;
}

const select = (entries: readonly (readonly [string, string])[], value: string, label = ""): HTMLSelectElement => {
  const made = element(
    "select",
    label ? { "aria-label": label } : {},
    ...entries.map(([key, words]) => element("option", { value: key }, words)),
  );
  made.value = value;
  return made;
};

export function questions(app: App, file: FileLine, act: (answers: Answers) => void): Form {
  const fields = new Map<string, (text: string) => void>(); // by the studio's names
  const rows = file.roles.map((role) => roleField(file, role, fields));
  const [diameter, angle] = [number(), number()];
  const needle = field("Diameter, mm", diameter);
  const tip = field("Tip angle, degrees", angle);
  fields.set("diameter_mm", (text) => needle.complain(text));
  fields.set("tip_angle_deg", (text) => tip.complain(text));
  const fill = (words: { diameter: string; angle: string }): void => {
    diameter.value = words.diameter;
    angle.value = words.angle;
  };
  if (file.needle) fill(needleWords(file.needle.diameter, file.needle.tip_angle));
  const asRunning = (): void => {
    const scene = app.live.scene.value;
    if (scene) fill(sceneNeedle(scene));
  };
  const same = button("As in the running scene", "", asRunning, "link");
  const counts = Array.from({ length: MOST_MEMBRANES }, (_, i) => [String(i + 1), String(i + 1)] as const);
  const membranes = select([["auto", "one for each pop"], ...counts], "auto");
  const walls = field("Membranes", membranes);
  fields.set("membranes", (text) => walls.complain(text));
  const digitised = element("input", { type: "checkbox" });
  const order = element("label", { class: "check" }, digitised, "Digitised curve of one insertion: sort by depth");
  const go = element("button", { type: "submit", class: "small primary" }, "Identify");
  const form = element(
    "form",
    { class: "trace-form", novalidate: true, "aria-label": `What the studio must know of ${file.name}` },
    ...rows.map(({ root }) => root),
    needle.root,
    tip.root,
    same,
    walls.root,
    ...(file.roles.length ? [order] : []),
    go,
  );
  const showComplaints = (complaints: Readonly<Record<string, string>>): void => {
    for (const [name, complain] of fields) complain(complaints[name] ?? "");
    form.querySelector<HTMLElement>('[aria-invalid="true"]')?.focus();
  };
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    for (const complain of fields.values()) complain("");
    const found = answersOf(file, {
      columns: Object.fromEntries(rows.map(({ role, column }) => [role, column.value])),
      units: Object.fromEntries(rows.map(({ role, unit }) => [role, unit.value])),
      digitised: digitised.checked,
      diameter: diameter.value,
      angle: angle.value,
      membranes: membranes.value,
    });
    if (isComplaints(found)) showComplaints(found);
    else act(found);
  });
  return {
    root: form,
    complain: (name, text) => {
      if (!fields.has(name)) return false;
      showComplaints({ [name]: text });
      return true;
    },
    lock: (locked) => {
      go.disabled = locked;
    },
  };
}

const number = (): HTMLInputElement =>
  element("input", { class: "number", type: "text", inputmode: "decimal", autocomplete: "off" });

interface RoleField extends Field {
  readonly role: string;
  readonly column: HTMLSelectElement;
  readonly unit: HTMLSelectElement;
}

/** Column and unit of a role. Another column brings its own unit, or none. */
function roleField(file: FileLine, role: RolePart, fields: Map<string, (text: string) => void>): RoleField {
  const name = role.role.charAt(0).toUpperCase() + role.role.slice(1);
  const none = role.needed ? "choose the column" : "none";
  const columns = file.columns.map((column) => [column.name, columnWords(column)] as const);
  const column = select([["", none], ...columns], role.column, `Column of the ${role.role}`);
  const units = role.units.map((unit) => [unit, unit] as const);
  const unit = select([["", "unit?"], ...units], statedUnit(file, role, role.column), `Unit of the ${role.role}`);
  unit.classList.add("unit");
  const made = field(name, column, unit);
  column.addEventListener("change", () => {
    unit.value = statedUnit(file, role, column.value);
    made.complain("");
  });
  unit.addEventListener("change", () => made.complain(""));
  // Both fields share one line: an empty text for one does not remove what is wrong with the other.
  const wrong = { column: "", unit: "" };
  const show = (): void => made.complain(wrong.column || wrong.unit, wrong.column ? column : unit);
  for (const what of ["column", "unit"] as const) {
    fields.set(`${what}.${role.role}`, (text) => {
      wrong[what] = text;
      show();
    });
  }
  return { ...made, role: role.role, column, unit };
}
