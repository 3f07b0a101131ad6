import { errorText, unbroken } from "../format.ts";
import { tellAwake } from "../hand/hand.ts";
import { button, element, keptList, named, type Panel } from "../panel.ts";
import type { App } from "../state/app.ts";
import { backToStage, pageOf } from "../state/page.ts";
import { resultPath } from "../wire/api.ts";
import type { ExerciseOverview, ExerciseStatus, ProblemPart, Result } from "../wire/messages.ts";
import { blockLine, watchBlock } from "./blocked.ts";
import { sentence } from "./editor/problems.ts";
import { DRAFT, expertChoice } from "./exercises/expert.ts";
import { goalList } from "./exercises/goals.ts";
import { exerciseMaker } from "./exercises/maker/maker.ts";
import { openPart } from "./exercises/open.ts";
import { pastResults } from "./exercises/past.ts";
import { Person, personFields } from "./exercises/person.ts";
import { openResult } from "./exercises/result_dialog.ts";
import { lostWords, showGoal, taskBar } from "./exercises/task.ts";
import { titleAmong } from "./exercises/title.ts";
import type { Opens } from "./tabs.ts";

/** The list of exercises, the running one, and past results. */
export const exercisesPanel: Panel = (host, app) => {
  host.classList.add("exercises-panel");
  const person = new Person();
  let known: readonly ExerciseOverview[] = [];
  let running = false;
  let before: ExerciseStatus | null = null;
  const of = (name: string): ExerciseOverview | null => known.find((exercise) => exercise.name === name) ?? null;
  const titleOf = (name: string, title = of(name)?.title ?? name): string => titleAmong({ name, title }, known);
  const start = async (name: string): Promise<void> => {
    const reply = await app.ask({
      do: "start_exercise",
      exercise: name,
      person: person.name.value,
      group: person.group.value,
    });
    if (reply?.ok) backToStage(pageOf(app));
    if (reply && !reply.ok && reply.problems.length)
      app.notify(`${titleOf(name)} cannot start: ${reply.problems.map(sentence).join(" ")}`);
    await readList(); // an exercise file may have changed
  };
  const open = (result: Result): void => {
    const again = app.control.value.you && of(result.exercise) ? () => void start(result.exercise) : null;
    openResult(app, result, titleOf(result.exercise, result.title), of(result.exercise), again, () => void readList());
  };
  const past = pastResults(app, open, (result) => titleOf(result.exercise, result.title));
  const task = element("div", { class: "task" });
  tellAwake(app);
  const showTitle = taskBar(task, app, titleOf);
  document.getElementById("app")?.append(task);
  const maker = exerciseMaker(app, person, () => readList());
  const opening = openPart(app, async (name) => {
    await readList();
    const start = list.querySelector<HTMLElement>(`[data-exercise="${CSS.escape(name)}"] header button`);
    start?.scrollIntoView({ block: "nearest" });
    start?.focus();
  });
  const list = element("fieldset", { class: "exercise-list" });
  host.append(
    element(
      "div",
      { class: "editor-top" },
      blockLine(app, "Force and depth decide the result."),
      ...personFields(person),
    ),
    maker,
    list,
    opening,
    past.root,
  );

  const showList = keptList<{ exercise: ExerciseOverview; title: string }>(list, ({ exercise, title }) =>
    card(app, exercise, title, () => void start(exercise.name), readList),
  );
  const readList = async (): Promise<void> => {
    try {
      known = await app.api.json<ExerciseOverview[]>("/api/exercises");
      showList(known.map((exercise) => ({ exercise, title: titleOf(exercise.name) })));
      showGoal(app, of);
      showTitle();
    } catch (error) {
      list.replaceChildren(element("p", { class: "quiet" }, `Cannot load the exercises: ${errorText(error)}`));
    }
  };
  app.connection.watch(async (state) => {
    if (state.state !== "open") return;
    await readList();
    await past.show(person);
  });
  let mine: boolean | null = null; // not known before the studio says it
  app.control.watch(({ you }) => {
    if (app.connection.value.state !== "open") return;
    if (you && mine === false) void readList(); // another page may have opened a file
    mine = you;
  });
  for (const word of [person.name, person.group])
    word.watch(() => {
      if (app.connection.value.state === "open") void past.show(person);
    });
  watchBlock(app, (block) => {
    list.disabled = block !== null;
  });
  app.live.scene.watch(() => showGoal(app, of));
  app.exercise.watch(async (status) => {
    const lost = lostWords(before, status, titleOf(before?.exercise ?? ""));
    before = status;
    if (lost) app.notify(lost);
    showGoal(app, of);
    list.hidden = status?.running ?? false;
    maker.hidden = list.hidden;
    opening.hidden = list.hidden;
    const ended = running && status !== null && !status.running;
    const begun = !running && (status?.running ?? false);
    running = status?.running ?? false;
    if (begun && !of(status!.exercise)) void readList(); // an exercise that another page tries before it is saved
    if (!ended || !status.result) return;
    try {
      open(await app.api.json<Result>(resultPath(status.result)));
    } catch (error) {
      app.notify(`Cannot load the result: ${errorText(error)}`);
    }
    await past.show(person);
  });
};

/** The tab opens when an exercise begins, and in a page that finds one running, as after a reload. */
export const whenOneRuns: Opens = (app, open) => {
  let running = false;
  app.exercise.watch((status) => {
    const now = status?.running ?? false;
    if (now && !running) open();
    running = now;
  });
};

function card(
  app: App,
  exercise: ExerciseOverview,
  title: string,
  start: () => void,
  changed: () => Promise<void>,
): HTMLElement {
  const wrong = exercise.problems.length > 0;
  return element(
    "article",
    { class: "exercise", "data-exercise": exercise.name },
    element(
      "header",
      {},
      named(element("h3"), title),
      // A file with a problem can be started too: it is read again, and may be corrected by then.
      button(wrong ? "Try again" : "Start", "", start, "small primary"),
    ),
    ...(wrong ? [problemList("problems", exercise.problems)] : []),
    ...(exercise.warnings.length > 0 ? [problemList("warnings", exercise.warnings)] : []),
    ...(exercise.unfelt ? [element("p", { class: "unfelt", role: "note" }, exercise.unfelt)] : []),
    element("p", {}, unbroken(exercise.description)),
    ...(exercise.note ? [element("p", { class: "quiet", role: "note" }, exercise.note)] : []),
    goalList(exercise.goals.map((text) => ({ text, state: "open" }))),
    ...(wrong || exercise.name === DRAFT ? [] : [expertChoice(app, exercise, () => void changed())]),
    ...(exercise.made ? [deletePart(app, exercise, () => void changed())] : []),
  );
}

/** A button that deletes the file of an exercise, after a second button is pressed. */
function deletePart(app: App, { name }: ExerciseOverview, changed: () => void): HTMLElement {
  const sure = element("span", { class: "tools sure", hidden: true });
  const ask = (open: boolean): void => {
    sure.hidden = !open;
    remove.hidden = open;
    (open ? keep : remove).focus();
  };
  const remove = button("Delete this file", "", () => ask(true));
  const keep = button("Cancel", "", () => ask(false));
  const really = button(
    "Delete permanently",
    "",
    () => void app.ask({ do: "delete_exercise", name }).then(changed),
    "small danger",
  );
  sure.append(keep, really);
  return element("div", { class: "tools" }, remove, sure);
}

function problemList(kind: "problems" | "warnings", problems: readonly ProblemPart[]): HTMLElement {
  const begin = kind === "warnings" ? "Warning: " : "";
  const list = problems.map((problem) => element("li", {}, begin + sentence(problem)));
  const role = kind === "problems" ? "alert" : "note"; // of a list itself it would take the list from its items
  return element("div", { role }, element("ul", { class: `file-${kind}` }, ...list));
}
