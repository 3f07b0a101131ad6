import { takeControl } from "../controls/control_line.ts";
import { fixedNumber, newton, unbroken } from "../format.ts";
import { handOf } from "../hand/hand.ts";
import { button, element, everyFrame, type Panel } from "../panel.ts";
import { leaveExcerpt, SHOW_AGAIN, showAgain } from "../pop/again.ts";
import { type DepthScale, type Framing, type Free, framingOf } from "../scene/framing.ts";
import type { App } from "../state/app.ts";
import type { History } from "../state/history.ts";
import { cutJustNow, cutSentence } from "../state/limits.ts";
import { pageOf, show } from "../state/page.ts";
import { feltDropText, feltShareText, scaleOf } from "../state/scale.ts";
import type { Source } from "../state/source.ts";
import { type Band, bandsOf } from "../tissue/bands.ts";
import { asTissue } from "../tissue/layers.ts";
import type { MembraneEvent, SceneView } from "../wire/messages.ts";
import { Attempt, feltAt, strongestAt, wholeOf } from "./attempt.ts";
import { CurvePicture, shortened } from "./curve.ts";
import { Sentence } from "./sentence.ts";

const ROOM = 1.15; // of the axis, beyond the greatest force
const SHORT = 7; // widths of a letter: of a pop's name where there is little room
const WORDS_MS = 100; // between two numbers; faster ones cannot be read

/** What opens first: one sentence, one force and one curve over the view, and three buttons. */
export const stage: Panel = (root, app) => {
  const page = pageOf(app);
  const framing = framingOf(app);
  const view = root.querySelector<HTMLElement>(":scope > .view")!;
  const picture = view.querySelector<HTMLElement>(".view-main > canvas")!; // hidden without WebGL
  const words = element("p", { class: "stage-sentence", role: "status" });
  const take = element("span", { hidden: true }, takeControl(app));
  const force = element("output", { class: "stage-number" });
  const name = element("span", { class: "stage-name" });
  const syringe = element("span", { class: "stage-name" });
  const cut = element("span", { class: "stage-cut" });
  const free = element("div", { class: "stage-free", "aria-hidden": "true" });
  const curve = new CurvePicture();
  const hold = button("Pause", "The picture stands still; the run goes on", () => {
    const { source } = app;
    if (source.value.live) app.pause();
    else if (source.value.excerpt) leaveExcerpt(app);
    else app.goLive();
  });
  const again = button("Again", "A new attempt: the needle goes back, and the curve begins anew", () => {
    app.goLive();
    attempts.live.begin();
    handOf(app).home();
    framing.again.value++;
  });
  const more = button("More", "The bench: every plot, table and setting (Alt+B)", () => show(page, "bench"));
  const keys = element("span", { class: "stage-keys" }, "The keys ↓ and ↑ move the needle.");
  const group = element("div", { role: "group", "aria-label": "Stage" }, hold, again, more);
  const buttons = element("div", { class: "stage-buttons" }, group, keys);
  const box = element(
    "section",
    { class: "stage", "aria-label": "Stage" },
    element("h1", { class: "only-read" }, "Punctura"),
    element("div", { class: "stage-words" }, words, take),
    element("div", { class: "stage-force" }, force, name, syringe),
    cut,
    free,
    curve.root,
    buttons,
  );
  root.append(box);
  const popped = popsInTissue(picture);

  const measure = (): void => {
    framing.free.value = page.value === "stage" ? shareOf(free, view) : null;
  };
  new ResizeObserver(measure).observe(free);
  new ResizeObserver(measure).observe(view);
  const thumb = view.querySelector<HTMLElement>(".thumb-button")!;
  const thumbHome = thumb.parentElement!;
  handOf(app).barred.watch((why) => {
    keys.hidden = why !== null;
  });
  page.watch((now) => {
    box.hidden = now !== "stage";
    if (now === "stage") group.after(thumb);
    else thumbHome.append(thumb);
    measure();
  });
  document.addEventListener("keydown", (event) => {
    if (!event.altKey || event.ctrlKey || event.code !== "KeyB") return;
    event.preventDefault();
    show(page, page.value === "stage" ? "bench" : "stage");
  });
  app.source.watch((source) => {
    hold.textContent = source.live ? "Pause" : "Go on";
  });
  let running = false;
  app.exercise.watch((status) => {
    const begins = !running && (status?.running ?? false);
    running = status?.running ?? false;
    if (begins && page.value === "stage") app.goLive(); // nobody may stand at a page that looks on
  });

  const attempts = new Attempts(app);
  const sentence = new Sentence(app);
  const marks = new Marks(app, curve);
  let scene: SceneView | null = null;
  let bands: Band[] = [];
  let wordsAt = 0;
  everyFrame((time) => {
    const { source } = app;
    attempts.live.follow();
    if (page.value !== "stage") return;
    const built = source.value.scene.value;
    if (built !== scene) {
      scene = built;
      bands = built ? bandsOf(asTissue(built)) : [];
      // An upright needle leaves room beside it; one that lies at a small angle, as for a vein, does not.
      root.style.setProperty("--curve-wider", built?.lumen.length ? "0px" : "16%");
    }
    const tick = source.value.shown();
    const now = built && tick !== null ? feltAt(source.value.history, built, tick) : null;
    const hidden = app.blind || !built;
    curve.root.hidden = hidden;
    popped(hidden || picture.hidden ? [] : attempts.shown().pops, framing.onScreen);
    if (built && !hidden) {
      const attempt = attempts.shown();
      const most = ROOM * Math.max(strongestAt(source.value, tick), attempt.most);
      const beside = besideOf(framing.depths.value, view, curve.root);
      const goal = app.goal.value;
      const anew = curve.show({ attempt, bands, most, beside, now, goal, marksGoal: picture.hidden !== false });
      marks.show(attempt, anew);
    }
    if (time - wordsAt < WORDS_MS) return;
    wordsAt = time;
    const { text, takeOver } = sentence.words(bands, hidden ? null : now);
    take.hidden = !takeOver;
    const gone = source.value.live && app.engine.studio && app.connection.value.state !== "open";
    write(force, now && !gone && Number.isFinite(now.force) ? newton(now.force).replace("-", "−") : "–");
    write(name, tick === null ? "" : feltShareText(scaleOf(source.value)));
    const told = built?.syringe && tick !== null && !app.blind;
    write(syringe, told ? injectedText(source.value.history, tick) : "");
    const cutAt = source.value.live && !gone ? cutJustNow(app.live.history) : null;
    const alone = cutAt !== null && !takeOver && !app.exercise.value?.running && !app.sitting.value;
    write(words, alone ? "" : text); // one thing to do at a time
    write(cut, cutAt === null ? "" : unbroken(cutSentence(app.live.history, cutAt)));
  });
};

/** Changes a text only if it is another one: screen readers read every change. */
function write(host: HTMLElement, text: string): void {
  if (host.textContent !== text) host.textContent = text;
}

/** Dots in the view where the tissue gave way. The curve's buttons at their heights show it again. */
function popsInTissue(picture: HTMLElement): (pops: Attempt["pops"], onScreen: Framing["onScreen"]) => void {
  const layer = element("div", { class: "stage-pops", "aria-hidden": "true" });
  picture.after(layer);
  return (pops, onScreen) => {
    while (layer.children.length > pops.length) layer.lastElementChild!.remove();
    while (layer.children.length < pops.length) layer.append(element("span", {}));
    pops.forEach(({ place }, i) => {
      const to = onScreen(place).map((px) => `${px.toFixed(0)}px`);
      const dot = layer.children[i] as HTMLElement;
      if (dot.style.translate !== to.join(" ")) dot.style.translate = to.join(" ");
    });
  };
}

/** What has left the syringe. Fluid that pushes the plunger back is no injection. */
const injectedText = (history: History, tick: number): string =>
  `${fixedNumber(Math.max(0, history.row("injected", tick)[0] ?? Number.NaN) * 1e6, 1)} mL injected`;

/** The place of one element in another, as shares of its size. */
function shareOf(part: HTMLElement, whole: HTMLElement): Free | null {
  const [a, b] = [part.getBoundingClientRect(), whole.getBoundingClientRect()];
  if (a.width < 1 || a.height < 1 || b.width < 1 || b.height < 1) return null;
  return {
    left: (a.left - b.left) / b.width,
    right: (a.right - b.left) / b.width,
    top: (a.top - b.top) / b.height,
    bottom: (a.bottom - b.top) / b.height,
  };
}

/** The view's scale of depths for the curve, if the curve stands beside the tissue and not below it. */
function besideOf(
  scale: DepthScale | null,
  view: HTMLElement,
  curve: HTMLElement,
): { scale: DepthScale; top: number } | null {
  const top = curve.getBoundingClientRect().top - view.getBoundingClientRect().top;
  const fits = scale && scale.px(0) > top && scale.px(scale.deep) < top + 1.2 * curve.clientHeight;
  return fits ? { scale, top } : null;
}

/** The attempt of the live run, and that of a recording while one is shown. */
class Attempts {
  readonly live: Attempt;
  private other: Attempt | null = null;

  constructor(private readonly app: App) {
    this.live = new Attempt(app.live);
  }

  shown(): Attempt {
    const source = wholeOf(this.app.source.value);
    if (source.live || source.paused) return this.live;
    if (this.other?.source !== source) this.other = new Attempt(source);
    this.other.follow();
    return this.other;
  }
}

/** A button at each pop of the curve, which shows it again, slowly. */
class Marks {
  private readonly known = new Map<Attempt["pops"][number], HTMLElement>();

  constructor(
    private readonly app: App,
    private readonly curve: CurvePicture,
  ) {}

  show({ pops, source }: Attempt, anew: boolean): void {
    for (const [pop, button] of this.known) {
      if (pops.includes(pop)) continue;
      button.remove();
      this.known.delete(pop);
    }
    const before = this.known.size;
    for (const pop of pops) if (!this.known.has(pop)) this.known.set(pop, this.add(pop.event, source));
    if (!anew && this.known.size === before) return;
    this.curve.place([...this.known].map(([{ force, depth }, button]) => ({ button, force, depth })));
  }

  private add(event: MembraneEvent, source: Source): HTMLElement {
    const drop = unbroken(feltDropText(source.history, event));
    const button = element(
      "button",
      {
        type: "button",
        title: SHOW_AGAIN,
        onclick: () => showAgain(this.app, event),
      },
      element("span", { class: "stage-pop" }, `Pop: ${event.name} `),
      element("span", { class: "stage-short", "aria-hidden": "true" }, shortened(event.name, SHORT, 1)),
      element("span", { class: "stage-drop" }, `${drop} `),
      element("span", { class: "stage-slowly" }, "again, slowly"),
    );
    this.curve.marks.append(button);
    return button;
  }
}
