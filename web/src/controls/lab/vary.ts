import { element, keptList } from "../../panel.ts";
import type { RecordingEntry, SceneField } from "../../wire/messages.ts";
import { fieldWords, plainNumber, shownUnit } from "./fields.ts";
import type { Job } from "./job.ts";

type Variation = Exclude<Job, { recordings: unknown }>;
const SPEEDS = [1, 2, 3, 5, 10, 20]; // mm/s
const MOST = 25; // runs, as in the studio
const AROUND = 0.5; // the range that is offered first: half of the value on either side

/** A form that chooses a field of the scene, its values and a motion. The runs are simulated in the studio. */
export function varyForm(act: (job: Variation, title: string) => void): {
  readonly root: HTMLElement;
  /** names: of the membranes. */
  offer(fields: readonly SceneField[], entries: readonly RecordingEntry[], names: readonly string[]): void;
} {
  const input = (label: string, more: Readonly<Record<string, string | number>>): [HTMLElement, HTMLInputElement] => {
    const made = element("input", { type: "number", step: "any", required: true, ...more });
    return [element("label", {}, element("span", {}, label), made), made];
  };
  const field = element("select", {});
  const motion = element("select", {});
  const option = ([value, text]: readonly [string, string]): HTMLElement => element("option", { value }, text);
  const [offerFields, offerMotions] = [keptList(field, option), keptList(motion, option)];
  const [fromRow, from] = input("From", {});
  const [toRow, to] = input("To", {});
  const [countRow, count] = input("Runs", { min: 1, max: MOST, step: 1, value: 5 });
  const unit = element("span", { class: "quiet" });
  let fields: readonly SceneField[] = [];
  const chosen = (): Pick<SceneField, "value" | "unit"> =>
    fields.find(({ path }) => path === field.value) ?? { value: 0, unit: "-" };
  const suggest = (): void => {
    const { value, unit: si } = chosen();
    const [name, gain] = shownUnit(si);
    unit.textContent = `now ${plainNumber(value * gain)} ${name}`;
    from.value = plainNumber(value * gain * (1 - AROUND), 4);
    to.value = plainNumber(value * gain * (1 + AROUND), 4);
  };
  field.addEventListener("change", suggest);
  const simulate = element("button", { type: "submit", class: "small primary", disabled: true }, "Simulate");
  const form = element(
    "form",
    { class: "lab-vary" },
    element("label", {}, element("span", {}, "Parameter"), field),
    unit,
    fromRow,
    toRow,
    countRow,
    element("label", {}, element("span", {}, "Motion"), motion),
    simulate,
  );
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    const by = motion.value.startsWith("stroke ") ? Number(motion.value.slice(7)) / 1e3 : motion.value.slice(10);
    const [, gain] = shownUnit(chosen().unit);
    // 0.285 / 1e-3 is not 285.
    const si = ({ value }: HTMLInputElement): number => Number((Number(value) / gain).toPrecision(12));
    const job = {
      path: field.value,
      from: si(from),
      to: si(to),
      count: Number(count.value),
      motion: by,
      id: Math.random().toString(36).slice(2),
    };
    act(job, `${field.selectedOptions[0]?.text ?? field.value} varied`);
  });
  return {
    root: element(
      "section",
      {},
      element("h3", {}, "Vary a parameter"),
      element("p", { class: "quiet" }, "The same motion, simulated once for each value. The run goes on meanwhile."),
      form,
    ),
    offer: (offered, entries, names) => {
      const [before, moved] = [field.value, motion.value];
      const valueAt = (path: string): number | undefined => fields.find((one) => one.path === path)?.value;
      const was = valueAt(before);
      fields = offered;
      offerFields(offered.map(({ path }) => [path, fieldWords(path, names)]));
      offerMotions([
        ...SPEEDS.map((speed) => [`stroke ${speed}`, `stroke at ${speed} mm/s`] as const),
        ...entries.map(({ name, title }) => [`recording ${name}`, `as in ${title || name}`] as const),
      ]);
      motion.value = moved || "stroke 5";
      const known = offered.some(({ path }) => path === before);
      if (known) {
        field.value = before;
        if (valueAt(before) !== was) suggest(); // the scene has changed
      } else {
        field.value = offered.find(({ path }) => path.startsWith("membrane[0]."))?.path ?? offered[0]?.path ?? "";
        suggest();
      }
      simulate.disabled = fields.length === 0; // without a field there is no value to vary
    },
  };
}
