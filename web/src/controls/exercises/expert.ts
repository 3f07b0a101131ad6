import type { Reply } from "../../engine/engine.ts";
import { button, element } from "../../panel.ts";
import type { App } from "../../state/app.ts";
import type { Source } from "../../state/source.ts";
import { recordingPath } from "../../wire/api.ts";
import type { ExerciseOverview, RecordingEntry, RecordingTrace, Result } from "../../wire/messages.ts";
import { words } from "../editor/problems.ts";
import { fetchSource } from "../recordings/fetch_source.ts";
import { type Trace, traceOf } from "./trace.ts";

/** The studio's name of an exercise that is tried before it is saved, and of its last result, which is not kept. */
export const DRAFT = "draft";

/** A button that names the result's recording as the expert's run of its exercise, or takes that back. */
export function expertButton(
  app: App,
  result: Result,
  exercise: ExerciseOverview | null,
  changed: () => void,
): HTMLElement[] {
  if (!exercise || exercise.name === DRAFT || !result.recording || !app.control.value.you) return [];
  const is = exercise.expert === result.recording;
  const act = async (): Promise<void> => {
    made.disabled = true;
    const recording = is ? "" : result.recording;
    const reply = await app.ask({ do: "set_expert", exercise: exercise.name, recording });
    if (!reply?.ok) {
      made.disabled = false;
      tellProblems(app, reply);
      return;
    }
    made.textContent = is ? "No longer the expert’s run" : "This is now the expert’s run";
    changed();
  };
  const words = is ? "Do not use as expert’s run" : "Use as expert’s run";
  const made = button(words, "Later attempts are drawn beside it", () => void act());
  return [made];
}

/** A choice of the expert's run among all recordings, which are read before it opens. */
export function expertChoice(app: App, exercise: ExerciseOverview, changed: () => void): HTMLElement {
  const option = (name: string, text = name): HTMLElement => element("option", { value: name }, text);
  const known = (): HTMLElement[] => [option("", "none"), ...(exercise.expert ? [option(exercise.expert)] : [])];
  const select = element("select", {}, ...known());
  select.value = exercise.expert;
  let read = false;
  const fill = async (): Promise<void> => {
    const entries = await app.api.json<RecordingEntry[]>("/api/recordings").catch(() => []);
    const others = entries.filter(({ name }) => name !== exercise.expert);
    select.replaceChildren(...known(), ...others.map(({ name }) => option(name)));
    select.value = exercise.expert;
    read = true;
  };
  const open = async (): Promise<void> => {
    await fill();
    select.focus();
    try {
      select.showPicker();
    } catch {
      // An old browser, or it took long: the next press opens the list.
    }
  };
  // An open list does not take in new entries in every browser.
  select.addEventListener("mousedown", (event) => {
    if (read) return;
    event.preventDefault();
    void open();
  });
  select.addEventListener("focus", () => {
    if (!read) void fill();
  });
  select.addEventListener("blur", () => {
    read = false;
  });
  select.addEventListener("change", () => {
    void app.ask({ do: "set_expert", exercise: exercise.name, recording: select.value }).then((reply) => {
      tellProblems(app, reply);
      if (!reply?.ok) select.value = exercise.expert;
      changed();
    });
  });
  return element("label", { class: "expert" }, "Expert’s run ", select);
}

/** Says what is wrong with a recording; `ask` has said any other refusal. */
function tellProblems(app: App, reply: Reply | null): void {
  if (reply && !reply.ok && reply.problems.length)
    app.notify(reply.problems.map(({ reason }) => words(reason)).join(" "));
}

/** Asks for the depth as the exercise judges it. */
export const judgedBy = (exercise: Pick<ExerciseOverview, "space"> | null): string =>
  exercise?.space[0] === undefined ? "" : `&before=${exercise.space[0]}`;

/** The curves of the expert's run, in its own time; null without one, or for the expert's run itself. */
export async function expertTrace(
  app: App,
  exercise: ExerciseOverview | null,
  recording: string,
  signal: AbortSignal,
): Promise<Trace | null> {
  if (!exercise?.expert || exercise.expert === recording) return null;
  try {
    const answer = await app.api.get(`${recordingPath(exercise.expert)}/trace?${judgedBy(exercise)}`, { signal });
    return traceOf((await answer.json()) as RecordingTrace);
  } catch {
    return null; // it was deleted
  }
}

/** Every tick of the expert's run, to lay over a replay; null without one. */
export async function expertSource(
  app: App,
  exercise: ExerciseOverview | null,
  recording: string,
  entries: readonly RecordingEntry[],
  signal: AbortSignal,
): Promise<Source | null> {
  const entry = entries.find(({ name }) => name === exercise?.expert);
  if (!entry || entry.name === recording) return null;
  try {
    return (await fetchSource(app.api, { ...entry, title: "expert’s run" }, () => void 0, signal)).source;
  } catch {
    return null;
  }
}

/** The time of the first contact, s: the first tick below the first surface. */
export function contactOf({ time, depth }: Trace): number {
  const row = depth.findIndex((value) => value > 0);
  return time[row < 0 ? 0 : row] ?? 0;
}
