import { takeControl } from "../controls/control_line.ts";
import { element, type Panel } from "../panel.ts";
import type { App } from "../state/app.ts";
import { pageOf } from "../state/page.ts";

/** Keys that move the needle while a session asks nothing; every other key is an answer, or nothing. */
const MOVES = ["ArrowDown", "ArrowUp", "Shift"];

/** A participant's session on the stage: its sentence is the stage's, below it are the answers. */
export const sitting: Panel = (root, app) => {
  const answers = element("div", { role: "group", "aria-label": "Answers" });
  const typed = element("input", {
    autocomplete: "off",
  });
  const off = (): void => void app.ask({ do: "pause" });
  const stop = element("button", { type: "button", class: "sitting-stop", onclick: off });
  const sound = maskingNoise(app);
  const box = element(
    "section",
    { class: "sitting-box", "aria-label": "Session", hidden: true },
    typed,
    answers,
    sound.missing,
    takeControl(app),
    stop,
  );
  root.append(box);
  const answer = (name: string): void => {
    const now = app.sitting.value;
    if (!now) return;
    void app.ask({ do: "respond", question: now.question, answer: name });
  };
  const show = (): void => {
    const now = app.sitting.value;
    const { classList } = document.documentElement;
    classList.toggle("sitting", now !== null);
    classList.toggle("covered", now?.covered ?? false);
    box.hidden = !now;
    sound.show();
    if (!now) return;
    pageOf(app).value = "stage";
    const gone = app.connection.value.state !== "open"; // then nobody takes an answer
    const buttons = (gone ? [] : now.answers).map(({ name, key }) =>
      element(
        "button",
        { type: "button", onclick: () => answer(name) },
        name,
        ...(name === key ? [] : [element("kbd", {}, key)]),
      ),
    );
    answers.replaceChildren(...buttons);
    stop.textContent = now.force_off;
    typed.placeholder = typed.ariaLabel = now.typed;
    typed.size = Math.max(now.typed.length, 1);
    typed.hidden = gone || !now.typed;
    typed.inputMode = now.answers.length ? "text" : "decimal";
    typed.value = "";
    const next = now.typed ? typed : root.querySelector<HTMLElement>('[role="application"]');
    next?.focus({ preventScroll: true });
  };
  app.sitting.watch(show);
  app.connection.watch(({ state }) => {
    if (state !== "open") show(); // it opens with the session's message
  });
  for (const gesture of ["keydown", "click"]) document.addEventListener(gesture, sound.begin, { capture: true });
  // Before the keys of the view, of the stage and of the bench.
  document.addEventListener("keydown", (event) => take(event), { capture: true });
  const take = (event: KeyboardEvent): void => {
    const now = app.sitting.value;
    if (!now || event.ctrlKey || event.metaKey || MOVES.includes(event.key)) return;
    if (event.target === typed && event.key !== "Escape") {
      if (event.key !== "Enter") return;
      answer(typed.value.trim());
      typed.value = ""; // what may be typed is read again if this was none of it
      return;
    }
    event.stopImmediatePropagation();
    if (event.repeat || event.altKey) return;
    if (event.key === "Escape") off();
    const same = ({ key }: { key: string }): boolean => key.toLowerCase() === event.key.toLowerCase();
    const chosen = now.answers.find(same);
    if (!chosen) return;
    event.preventDefault();
    answer(chosen.name);
  };
};

/** Pink noise is white noise, whose loop has no click, filtered as in J. O. Smith, Spectral Audio Signal Processing,
 * 2011; 4: then its largest values are near 1. */
export const FEEDFORWARD = [0.049922035, -0.095993537, 0.050612699, -0.004408786].map((b) => 4 * b);
export const FEEDBACK = [1, -2.494956002, 2.017265875, -0.5221894];
const NOISE_S = 20;

/** Browsers block sound that no key and no click began. An answer by the device's buttons is neither. */
function maskingNoise(app: App): { begin: () => void; show: () => void; missing: HTMLElement } {
  const missing = element("p", { role: "status", hidden: true });
  let context: AudioContext | null = null;
  let told: boolean | null = null; // to the studio
  const show = (): void => {
    const plays = context?.state === "running";
    missing.textContent = app.sitting.value?.sound ?? "";
    missing.hidden = !app.sitting.value?.noise || plays;
    const heard = app.sitting.value?.noise && app.control.value.you && app.connection.value.state === "open";
    if (heard && told !== plays) void app.ask({ do: "sound", plays });
    told = heard ? plays : null;
  };
  app.control.watch(show);
  const begin = (): void => {
    if (!app.sitting.value?.noise) return;
    context ??= noise(show);
    void context.resume();
  };
  return { begin, show, missing };
}

function noise(changed: () => void): AudioContext {
  const context = new AudioContext();
  context.onstatechange = changed;
  const buffer = context.createBuffer(1, NOISE_S * context.sampleRate, context.sampleRate);
  const samples = buffer.getChannelData(0);
  for (let i = 0; i < samples.length; i++) samples[i] = 2 * Math.random() - 1;
  const white = new AudioBufferSourceNode(context, { buffer, loop: true });
  const pink = new IIRFilterNode(context, { feedforward: FEEDFORWARD, feedback: FEEDBACK });
  white.connect(pink).connect(context.destination);
  white.start();
  return context;
}
