import { unbroken } from "../../format.ts";
import { button, element, named } from "../../panel.ts";
import type { App } from "../../state/app.ts";
import type { ExerciseOverview, ExerciseStatus } from "../../wire/messages.ts";
import { watchBlock } from "../blocked.ts";
import { svg } from "../svg.ts";
import { goalList } from "./goals.ts";
import { layersOf, spaceOf } from "./trace.ts";

const RADIUS = 17;
const AROUND = 2 * Math.PI * RADIUS;

/**
 * The running exercise, always in sight: what to do now, the goals, the time held and the clock. The returned function
 * shows its title again, when the list of exercises has been read.
 */
export function taskBar(host: HTMLElement, app: App, titleOf: (name: string) => string): () => void {
  const title = element("h2", {});
  const instruction = element("p", { class: "instruction", role: "status" });
  const goals = element("div", { class: "task-goals" });
  const clock = element("p", { class: "clock", role: "timer", "aria-live": "off" });
  const ring = holdRing();
  const end = button("End", "", () => void app.ask({ do: "end_exercise" }));
  const root = element(
    "section",
    { class: "running tab", hidden: true, "aria-label": "Exercise" },
    ring.root,
    element("div", { class: "task-words" }, title, instruction),
    goals,
    element("div", { class: "task-end" }, clock, end),
  );
  host.append(root);
  new ResizeObserver(() => {
    document.documentElement.style.setProperty("--task-height", `${host.offsetHeight}px`);
  }).observe(host);
  watchBlock(app, (block) => {
    end.disabled = block !== null;
  });
  let shown = "";
  let begun = false;
  // The button that was pressed is hidden now, or the page has just been loaded. The keys of the view move the needle,
  // and a page that scrolls stood at the list.
  const begin = (): void => {
    const running = app.exercise.value?.running ?? false;
    if (running && !begun && app.control.value.you) {
      const view = document.querySelector<HTMLElement>(".view-main > canvas:not([hidden]), .view-main[tabindex]");
      view?.focus({ preventScroll: true }); // the second one is without WebGL
      view?.scrollIntoView({ block: "start" });
    }
    begun = running && app.control.value.you;
  };
  app.control.watch(begin);
  const showTitle = (): void => {
    const name = app.exercise.value?.exercise;
    named(title, name === undefined ? "" : titleOf(name));
  };
  app.exercise.watch((status) => {
    const running = status?.running ?? false;
    root.hidden = !running;
    document.documentElement.classList.toggle("exercising", running);
    document.documentElement.classList.toggle("blind", app.blind);
    begin();
    if (!status || !running) return;
    showTitle();
    const words = unbroken(status.instruction);
    if (instruction.textContent !== words) instruction.textContent = words;
    clock.textContent = clockText(status);
    ring.show(status);
    const states = JSON.stringify(status.goals);
    if (states !== shown) goals.replaceChildren(goalList(status.goals));
    shown = states;
  });
  return showTitle;
}

/** Tells the view what the running exercise asks to reach. */
export function showGoal(app: App, of: (name: string) => ExerciseOverview | null): void {
  const status = app.exercise.value;
  const exercise = status?.running && !status.blind ? of(status.exercise) : null;
  const space = exercise && spaceOf(layersOf(app.live.scene.value?.membranes ?? []), exercise);
  const now = app.goal.value;
  if (!space || !exercise) {
    app.goal.value = null;
    return;
  }
  const next = { name: exercise.space_name, top: space.top, bottom: space.bottom, line: exercise.line };
  if (JSON.stringify(now) !== JSON.stringify(next)) app.goal.value = next;
}

/** What to say if a studio that was started again knows nothing of the exercise that ran before; null if it does. */
export function lostWords(before: ExerciseStatus | null, now: ExerciseStatus | null, title: string): string | null {
  if (!before?.running || now?.exercise !== "") return null;
  const again = "To begin again, press Start in the tab Exercises (on the stage: under More).";
  return `The studio has started again, and the attempt is lost: ${title}. ${again}`;
}

/** "12 s of 60 s", or "12 s". It stands still before the first contact. */
export function clockText({ time, time_limit }: Pick<ExerciseStatus, "time" | "time_limit">): string {
  const passed = `${Math.floor(time)} s`;
  return time_limit === null ? passed : `${passed} of ${time_limit} s`;
}

/** How much of the stay is done, from 0 to 1. */
export function heldShare({ held, hold }: Pick<ExerciseStatus, "held" | "hold">): number {
  return hold > 0 ? Math.min(1, held / hold) : 0;
}

/** A ring that fills while the needle stays in the space. */
function holdRing(): { root: HTMLElement; show(status: ExerciseStatus): void } {
  const arc = svg("circle", { class: "arc", cx: 22, cy: 22, r: RADIUS, "stroke-dasharray": `0 ${AROUND}` });
  const words = svg("text", { x: 22, y: 26, "text-anchor": "middle" }, "0.0 s");
  const drawing = svg(
    "svg",
    { viewBox: "0 0 44 44", "aria-hidden": "true" },
    svg("circle", { cx: 22, cy: 22, r: RADIUS }),
    arc,
    words,
  );
  const root = element("div", {
    class: "hold-ring",
    role: "progressbar",
    "aria-valuemin": 0,
    "aria-label": "Time held",
  });
  root.append(drawing);
  return {
    root,
    show: (status) => {
      const { held, hold } = status;
      root.hidden = hold === 0;
      root.classList.toggle("holding", held > 0);
      root.setAttribute("aria-valuemax", String(hold));
      root.setAttribute("aria-valuenow", String(held));
      root.setAttribute("aria-valuetext", `${held.toFixed(1)} of ${hold} s`);
      arc.setAttribute("stroke-dasharray", `${heldShare(status) * AROUND} ${AROUND}`);
      words.textContent = `${held.toFixed(1)} s`;
    },
  };
}
