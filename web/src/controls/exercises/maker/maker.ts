import { errorText } from "../../../format.ts";
import { button, element } from "../../../panel.ts";
import type { App } from "../../../state/app.ts";
import { backToStage, pageOf } from "../../../state/page.ts";
import type { SceneOutline } from "../../../wire/messages.ts";
import { sentence, words } from "../../editor/problems.ts";
import type { Person } from "../person.ts";
import {
  changed,
  type Draft,
  draftOf,
  type ExerciseSchema,
  type FieldName,
  fieldOf,
  type GoalField,
  goalFields,
  nameOf,
  tablesOf,
} from "./draft.ts";
import { DepthStrip } from "./strip.ts";

const PLACES = ["from", "to", "angle", "wholeTip"] as const; // have their meaning in one scene only
const WAIT_MS = 300; // after the last change, before the server checks

/** A form for an exercise: goals on a picture of the depths and in fields. `saved` is called after saving. */
export function exerciseMaker(app: App, person: Person, saved: () => Promise<void>): HTMLElement {
  let scenes: readonly SceneOutline[] = [];
  let fields: readonly GoalField[] = [];
  let draft: Draft | null = null;
  const edited = new Set<FieldName>(); // by the teacher
  let toml = "";
  const form = element("div", { class: "maker-form" });
  const note = element("p", { class: "maker-note", role: "status" });
  const strip = new DepthStrip((edge, mm) => change({ [edge]: mm }));
  const root = element("details", { class: "maker" }, element("summary", {}, "Make an exercise"), form, note);
  const places = new Map<FieldName, HTMLElement>();
  const updates: (() => void)[] = [];
  const scene = (): SceneOutline => scenes.find(({ name }) => name === draft?.scene) ?? scenes[0]!;

  const tables = () => tablesOf(draft!, scene(), fields);
  let timer: ReturnType<typeof setTimeout> | undefined;
  const change = (part: Partial<Draft>): void => {
    if (!draft) return;
    if (part.scene !== undefined) for (const key of PLACES) edited.delete(key);
    else if (part.behind === undefined) for (const key of Object.keys(part)) edited.add(key as FieldName);
    draft = changed(draft, part, scenes.find(({ name }) => name === (part.scene ?? draft?.scene))!, edited);
    if (part.scene !== undefined) build();
    show();
    clearTimeout(timer);
    timer = setTimeout(() => void check(), WAIT_MS);
  };
  const show = (): void => {
    strip.show(draft!, scene());
    for (const update of updates) update();
  };
  const complain = (problems: readonly { path: string; value: string; reason: string }[]): void => {
    for (const place of places.values()) place.textContent = "";
    const left = problems.filter((problem) => {
      const field = fieldOf(problem.path, tables());
      const place = field && places.get(field);
      if (place) place.textContent = `${place.textContent} ${words(problem.reason)}`.trim();
      return !place;
    });
    note.textContent = left.map(sentence).join(" ");
  };
  const showReply = (reply: Awaited<ReturnType<App["ask"]>>, good: string): boolean => {
    if (!reply) return false;
    complain(reply.problems);
    if (reply.ok) note.textContent = [good, reply.text].filter(Boolean).join(" ");
    else if (!reply.problems.length) note.textContent = reply.text;
    return reply.ok;
  };
  const check = async (): Promise<boolean> => {
    const reply = await app.ask({ do: "check_exercise", tables: tables() });
    toml = String(reply?.data.toml ?? "");
    return showReply(reply, "");
  };
  const attempt = async (): Promise<void> => {
    const who = { person: person.name.value, group: person.group.value };
    clearTimeout(timer); // a check would clear what the reply says
    const reply = await app.ask({ do: "try_exercise", tables: tables(), ...who });
    if (!showReply(reply, "It runs now.")) return;
    backToStage(pageOf(app));
    await saved();
  };
  const save = async (): Promise<void> => {
    clearTimeout(timer);
    const name = nameOf(draft!.title);
    const ask = { do: "save_exercise", name, tables: tables() } as const;
    const reply = await app.ask({ ...ask, replace: replace.checked });
    if (showReply(reply, `“${draft!.title}” is in the list.`)) await saved();
  };
  const download = async (): Promise<void> => {
    if (!(await check())) return;
    const link = element("a", { download: `${nameOf(draft!.title)}.toml` });
    link.href = URL.createObjectURL(new Blob([toml], { type: "application/toml" }));
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  };
  const replace = element("input", { type: "checkbox", id: "maker-replace" });

  const row = (
    key: FieldName,
    label: string,
    box: HTMLInputElement | HTMLTextAreaElement | HTMLSelectElement,
  ): HTMLElement => {
    box.id = `maker-${key}`;
    const problem = element("p", { class: "error", role: "alert", id: `maker-${key}-problem` });
    box.setAttribute("aria-describedby", problem.id);
    places.set(key, problem);
    return element("div", { class: "field maker-field" }, element("label", { for: box.id }, label), box, problem);
  };
  const line = (key: "title" | "instruction" | "space", label: string): HTMLElement => {
    const long = key === "instruction"; // a sentence, which must be readable as a whole
    const style = { class: "words", maxlength: 200 };
    const box = long ? element("textarea", { ...style, rows: 3 }) : element("input", { ...style, type: "text" });
    box.addEventListener("change", () => change({ [key]: box.value.replace(/\s+/g, " ") }));
    updates.push(() => {
      box.value = draft![key];
    });
    return row(key, label, box);
  };
  const number = (
    key: FieldName,
    label: string,
    optional: boolean,
    now: () => number | null,
    act: (value: number | null) => void,
  ): HTMLElement => {
    const placeholder = optional ? "not asked" : "";
    const box = element("input", { type: "number", class: "words", step: "any", placeholder });
    box.addEventListener("change", () => {
      const value = box.value === "" ? null : Number(box.value);
      if (value !== null || optional) act(value);
      else show();
    });
    updates.push(() => {
      box.value = String(now() ?? "");
    });
    return row(key, label, box);
  };
  const place = (key: "from" | "angle" | "to", label: string, optional = false): HTMLElement =>
    number(
      key,
      label,
      optional,
      () => draft![key],
      (value) => change({ [key]: value }),
    );
  const choice = (
    key: FieldName,
    label: string,
    options: [string, string][],
    now: () => string,
    act: (value: string) => void,
  ): HTMLElement => {
    const box = element("select", {}, ...options.map(([value, text]) => element("option", { value }, text)));
    box.addEventListener("change", () => act(box.value));
    updates.push(() => {
      box.value = now();
    });
    return row(key, label, box);
  };
  /** A field without a value does not ask for its goal. */
  const goal = ({ kind, label, membrane }: GoalField, membranes: [string, string][]): HTMLElement => {
    const now = (): number | string | null => draft!.goals[kind] ?? null;
    const ask = (value: number | string | null): void => {
      const { [kind]: _, ...others } = draft!.goals;
      change({ goals: value === null || value === "" ? others : { ...others, [kind]: value } });
    };
    if (!membrane) return number(`goal.${kind}`, label, true, () => now() as number | null, ask);
    return choice(`goal.${kind}`, label, [["", "not asked"], ...membranes], () => String(now() ?? ""), ask);
  };
  const tick = (key: "wholeTip" | "blind", label: string): HTMLElement => {
    const box = element("input", { type: "checkbox" });
    box.addEventListener("change", () => change({ [key]: box.checked }));
    updates.push(() => {
      box.checked = draft![key];
    });
    return row(key, label, box);
  };

  const build = (): void => {
    updates.length = 0;
    places.clear();
    const membranes = scene().membranes.map(({ name }): [string, string] => [name, name]);
    form.replaceChildren(
      line("title", "Title"),
      line("instruction", "Instruction"),
      choice(
        "scene",
        "Scene",
        scenes.map(({ name, title }) => [name, title]),
        () => draft!.scene,
        (name) => change({ scene: name }),
      ),
      choice(
        "behind",
        "Goal behind the membrane",
        membranes,
        () => draft!.behind,
        (behind) => change({ behind }),
      ),
      strip.root,
      place("from", "Upper edge, mm behind its far face"),
      place("to", "Lower edge, mm behind its far face", true),
      line("space", "Name of the goal"),
      tick("wholeTip", "Whole tip in the goal, not only the point"),
      place("angle", "Needle to skin, degrees"),
      ...fields.filter(({ needsSyringe }) => scene().syringe || !needsSyringe).map((field) => goal(field, membranes)),
      tick("blind", "Blind: hide needle and depth"),
      element(
        "div",
        { class: "tools" },
        button("Try", "", () => void attempt(), "small primary"),
        button("Save on this computer", "", () => void save()),
        button("Download file", "", () => void download()),
      ),
      element(
        "div",
        { class: "maker-replace" },
        replace,
        element("label", { for: "maker-replace" }, "Replace a saved one"),
      ),
    );
  };
  root.addEventListener("toggle", async () => {
    if (!root.open || draft) return;
    try {
      scenes = await app.api.json<SceneOutline[]>("/api/scenes");
      fields = goalFields(await app.api.json<ExerciseSchema>("/api/exercise-schema"));
    } catch (error) {
      note.textContent = `Cannot load the form: ${errorText(error)}`;
      return;
    }
    draft = draftOf(scenes.find(({ title }) => title === app.live.scene.value?.name) ?? scenes[0]!);
    build();
    show();
    await check();
  });
  return root;
}
