import { element } from "../panel.ts";
import { CanvasPen } from "../plots/kit/canvas_pen.ts";
import { apart, textWidth } from "../plots/kit/labels.ts";
import { Polyline } from "../plots/kit/polyline.ts";
import { label, niceStep, Scale, ticks } from "../plots/kit/scale.ts";
import { colourOf, type Theme, watchTheme } from "../plots/kit/theme.ts";
import type { DepthScale } from "../scene/framing.ts";
import { bandOf } from "../scene/goal_mark.ts";
import type { Goal } from "../state/app.ts";
import type { Band } from "../tissue/bands.ts";
import { ABOVE_MM, type Attempt, type Felt } from "./attempt.ts";

const AXIS = 34; // px, of the numbers of the depth
const TOP = 2.6; // widths of a letter: the name and the numbers of the force
const EDGE = 10; // px
const NAME_EDGE = 6; // px, left of a layer's name
const PULL = 0.3; // of the greatest force: room for a force that pulls
const MARKS = 9; // widths of a letter: the room for the buttons, right of the greatest force
const SEAM = 20; // points that are drawn again with new ones: pieces of less than a pixel do not cover one
const NAMES = 0.45; // of the width without the buttons: the most that the names take, left of the curve

/** What the curve shows at present. */
interface Shown {
  readonly attempt: Attempt;
  readonly bands: readonly Band[];
  /** The greatest force to make room for, N. */
  readonly most: number;
  /** Where the view has these depths, and where the curve's box begins in it, px; null: the curve's own scale. */
  readonly beside: { readonly scale: DepthScale; readonly top: number } | null;
  readonly now: Felt | null;
  /** What an exercise asks to reach. */
  readonly goal: Goal | null;
  /** Whether no view shows it. */
  readonly marksGoal: boolean;
}

/** A button at a pop: force in N, depth in mm. */
interface Mark {
  readonly button: HTMLElement;
  readonly force: number;
  readonly depth: number;
}

/** The felt force to the right against the depth downwards, on the layers. Draws only what is new. */
export class CurvePicture {
  readonly root: HTMLElement;
  /** For buttons at the pops; placed with `place`. */
  readonly marks = element("div", { class: "stage-marks" });
  private readonly canvas = element("canvas", { "aria-hidden": "true" });
  private readonly head = element("span", { class: "stage-head", "aria-hidden": "true" });
  private readonly goal = element("span", { class: "stage-goal", hidden: true });
  private readonly pen: CanvasPen;
  private readonly force = new Scale();
  private readonly piece = new Polyline(64);
  private theme: Theme | null = null;
  private width = 0;
  private height = 0;
  private letter = 13; // px
  private changes = 0;
  private drawn = "";
  private attempt: Attempt | null = null;
  private generation = -1; // of the attempt
  private points = 0; // of the attempt that are drawn
  private most = 0;
  private bottom = 0; // mm, of the scene's layers
  private deep = 0; // mm, to which the axis goes
  private depth: (mm: number) => number = () => 0;
  private axis = 0; // px, where the lines of the force begin, below its numbers

  constructor() {
    this.root = element("div", { class: "stage-curve" }, this.canvas, this.goal, this.head, this.marks);
    this.pen = new CanvasPen(this.canvas.getContext("2d")!);
    watchTheme((theme) => {
      this.theme = theme;
      this.changes++;
    });
    new ResizeObserver(() => this.fit()).observe(this.root);
  }

  private fit(): void {
    this.width = this.root.clientWidth;
    this.height = this.root.clientHeight;
    this.letter = Number.parseFloat(getComputedStyle(this.root).fontSize) || this.letter;
    this.canvas.width = Math.max(1, Math.round(this.width * devicePixelRatio));
    this.canvas.height = Math.max(1, Math.round(this.height * devicePixelRatio));
    this.changes++;
  }

  /** Returns whether everything was drawn anew, so that marks must be placed again. */
  show(shown: Shown): boolean {
    const { theme, width, height } = this;
    if (!theme || width < 60 || height < 60) return false;
    const { attempt, bands, beside } = shown;
    const { generation, pops } = attempt;
    if (attempt !== this.attempt || generation !== this.generation) {
      // Another curve: how great forces and depths were is forgotten.
      [this.attempt, this.generation] = [attempt, generation];
      this.most = this.bottom = 0;
      this.changes++;
    }
    while (this.most < shown.most) this.most = Math.max(shown.most, 1.3 * this.most);
    this.deepen(shown);
    const scale = beside ? [beside.top, beside.scale.px(0), beside.scale.px(beside.scale.deep)] : [];
    const named = [bands.length, bands.at(-1)?.bottom];
    const state = [this.changes, pops.length, this.most, this.deep, ...named, ...scale].join(" ");
    const anew = state !== this.drawn;
    if (anew) {
      this.drawn = state;
      this.points = 0;
      this.arrange(shown);
      this.pen.begin(width, height, devicePixelRatio);
      this.drawGround(theme);
      this.drawBands(bands, theme);
      this.drawAxes(bands, theme);
    }
    this.drawNew(attempt, theme);
    this.drawHead(shown.now);
    this.drawGoal(shown);
    return anew;
  }

  /** The axis goes as deep as the scene's layers, the needle and the goal; the bands end with the drawn tissue. */
  private deepen({ attempt, bands, goal }: Shown): void {
    const bottom = bands.at(-1)?.bottom ?? 10;
    if (bottom !== this.bottom) this.bottom = this.deep = bottom;
    const needed = Math.max(attempt.deepest, goal && Number.isFinite(goal.bottom) ? bandOf(goal)[1] : 0);
    this.deep = endOf(this.deep, needed);
  }

  /**
   * Puts buttons in a column on the right, none over another, each with a line to its place on the curve. They say
   * less if they are many. Where there is no room for all, those of the last pops are there, and the others' dots.
   */
  place(buttons: readonly Mark[]): void {
    const { pen, theme, marks } = this;
    if (!theme) return;
    for (const { button } of buttons) button.hidden = false;
    let high = 0;
    let fit = 0;
    for (const words of ["all", "two", "name"]) {
      marks.dataset.words = words;
      high = Math.max(0, ...buttons.map(({ button }) => button.offsetHeight));
      fit = Math.floor(this.height / (high + 2));
      if (fit >= buttons.length) break;
    }
    const first = Math.max(0, buttons.length - fit);
    for (const { button } of buttons.slice(0, first)) button.hidden = true;
    const colour = colourOf(theme, 1);
    this.draw(buttons.slice(first), high, pen, colour);
    for (const { force, depth } of buttons) pen.dot(this.force.px(force), this.depth(depth), 4, colour, theme.panel);
  }

  private draw(buttons: readonly Mark[], high: number, pen: CanvasPen, colour: string): void {
    const middles = apart(
      buttons.map(({ depth }) => this.depth(depth)),
      high + 2,
      [high / 2, this.height - high / 2],
    );
    buttons.forEach(({ button, force, depth }, i) => {
      const left = this.width - EDGE - button.offsetWidth;
      const [x, y] = [this.force.px(force), this.depth(depth)];
      pen.segment(x, y, left, middles[i]!, { colour, width: 1.5 });
      button.style.transform = `translate(${left.toFixed(0)}px, ${(middles[i]! - high / 2).toFixed(0)}px)`;
    });
  }

  private arrange({ bands, beside }: Shown): void {
    const right = this.width - EDGE - MARKS * this.letter;
    const names = Math.max(0, ...bands.map(({ name }) => textWidth(name, this.letter - 1)));
    const share = Math.min(NAMES, (names + EDGE) / Math.max(1, right - AXIS));
    const pull = Math.max(PULL, share / (1 - share));
    this.force.set(-pull * this.most, this.most, AXIS, right);
    if (beside) {
      this.depth = (mm) => beside.scale.px(mm) - beside.top;
      return;
    }
    const { deep } = this;
    const from = (TOP + 2) * this.letter;
    this.depth = (mm) => from + (mm / deep) * (this.height - EDGE - from);
  }

  /** The tissue and the trail of the view follow the needle, and would come under the numbers and the curve. */
  private drawGround(theme: Theme): void {
    const { pen, width, height, depth, letter, deep } = this;
    // The numbers of the force stand above the skin.
    this.axis = Math.max(TOP * letter, Math.min(depth(0) - 2 * letter, height));
    const top = this.axis - TOP * letter;
    pen.box(0, top, width, Math.min(height, depth(deep)) - top, theme.panel, 1);
  }

  private drawBands(bands: readonly Band[], theme: Theme): void {
    const { pen, width, depth } = this;
    for (const { tone, membrane, top, bottom } of bands) {
      const high = Math.max(2, depth(bottom) - depth(top));
      const colour = tone
        ? `rgb(${tone.map(Math.round).join(" ")})`
        : membrane === null
          ? null
          : colourOf(theme, membrane);
      if (colour) pen.box(AXIS, depth(top), width - AXIS, high, colour, tone ? 0.5 : 0.3);
    }
  }

  private drawAxes(bands: readonly Band[], theme: Theme): void {
    const { pen, width, height, force, depth, letter, axis, deep } = this;
    const quiet = { colour: theme.quiet, size: letter - 1 } as const;
    const skin = depth(0);
    const end = Math.min(height, depth(deep));
    const step = niceStep(force.max - force.min, Math.max(2, width / (8 * letter)));
    for (const value of ticks(force.min, force.max, step)) {
      const x = Math.round(force.px(value)) + 0.5;
      const strong = Math.abs(value) < step / 2;
      pen.segment(x, axis, x, end, {
        colour: strong ? theme.quiet : theme.line,
        width: 1,
        alpha: strong ? 0.9 : 0.7,
      });
      if (x < width - 14) pen.text(x, axis - 0.7 * letter, label(value, step), { ...quiet, anchor: "middle" });
    }
    pen.text(AXIS, axis - 2 * letter, "felt force (N)", { ...quiet, colour: theme.text });
    pen.text(2, skin - letter, "depth (mm)", { ...quiet, colour: theme.text });
    const down = niceStep(deep, Math.max(2, (depth(deep) - skin) / 44));
    for (const value of ticks(0, deep, down)) {
      const y = Math.round(depth(value)) + 0.5;
      if (y > height - 5) break;
      pen.segment(AXIS - 4, y, AXIS, y, { colour: theme.quiet, width: 1 });
      pen.text(AXIS - 7, y, label(value, down), { ...quiet, anchor: "end" });
    }
    // Of the layers, on the left, where only a force that pulls is drawn; over the lines.
    for (const { name, y } of placedNames(bands, depth, letter, height - EDGE)) {
      const text = shortened(name, force.px(0) - AXIS - NAME_EDGE, letter - 1);
      pen.text(AXIS + NAME_EDGE, y, text, { colour: theme.text, size: letter - 1, halo: theme.panel });
    }
  }

  private drawNew({ path }: Attempt, theme: Theme): void {
    const { pen, piece, force, depth } = this;
    if (path.count <= this.points) return;
    piece.clear();
    for (let i = Math.max(0, this.points - SEAM); i < path.count; i++) {
      if (Number.isNaN(path.ys[i]!)) piece.gap();
      else piece.add(force.px(path.xs[i]!), depth(path.ys[i]!));
    }
    this.points = path.count;
    const { axis, width, height } = this;
    pen.within(AXIS, axis, width - AXIS, height - axis, () => pen.line(piece, { colour: theme.text, width: 2.5 }));
  }

  private drawGoal({ goal, marksGoal }: Shown): void {
    const { style } = this.goal;
    this.goal.hidden = goal === null || !marksGoal;
    if (!goal || !marksGoal) return;
    const [top, bottom] = bandOf(goal).map((mm) => this.depth(Math.min(mm, this.deep)));
    const words = `Goal: ${goal.name}`;
    if (this.goal.textContent !== words) this.goal.textContent = words;
    style.left = `${AXIS}px`;
    style.top = `${top!.toFixed(0)}px`;
    style.height = `${(bottom! - top!).toFixed(0)}px`;
  }

  private drawHead(now: Felt | null): void {
    const { head } = this;
    const y = now && this.depth(now.depth);
    const out = now === null || now.depth < -ABOVE_MM || y === null || !Number.isFinite(y) || y < this.axis;
    if (head.hidden !== out) head.hidden = out;
    if (out) return;
    const place = `translate(${this.force.px(now.force).toFixed(0)}px, ${Math.min(this.height, y).toFixed(0)}px)`;
    if (head.style.transform !== place) head.style.transform = place;
  }
}

/** A name that has so much room, px, to the left of the curve. */
export function shortened(name: string, room: number, size: number): string {
  const most = Math.max(3, Math.floor((1.15 * room) / textWidth("a", size))); // that width is rather too large
  if (name.length <= most) return name;
  const number = /\s*\d+$/.exec(name)?.[0] ?? ""; // tells it from the others
  return `${name.slice(0, Math.max(1, most - 1 - number.length)).trimEnd()}…${number}`;
}

/** How deep the axis goes, mm, if it must go so deep: in steps, because all is drawn anew at each. */
export const endOf = (deep: number, needed: number): number =>
  needed > deep ? Math.max(1.05 * needed, 1.2 * deep) : deep;

/**
 * The names of the layers with their heights. Each is at its own layer, at most half a letter away; where there is no
 * room for that, the names of the thinnest layers are left out.
 */
export function placedNames(
  bands: readonly Band[],
  depth: (mm: number) => number,
  letter: number,
  lowest: number,
): { name: string; y: number }[] {
  const high = ({ top, bottom }: Band): number => depth(bottom) - depth(top);
  let named = bands.filter(({ name }) => name !== "");
  for (;;) {
    const wanted = named.map(({ top, bottom }) => Math.min(lowest, depth((top + bottom) / 2)));
    const placed = apart(wanted, letter + 1, [Number.NEGATIVE_INFINITY, lowest]);
    if (named.every((band, i) => Math.abs(placed[i]! - wanted[i]!) <= Math.max(letter, high(band)) / 2))
      return named.map(({ name }, i) => ({ name, y: placed[i]! }));
    // Of layers that are as thin, the one that stands closest to its neighbours: so every second one goes, and so on.
    const thin = Math.min(...named.map(high)) + 0.5;
    const room = (i: number): number =>
      (wanted[i + 1] ?? Number.POSITIVE_INFINITY) - (wanted[i - 1] ?? Number.NEGATIVE_INFINITY);
    const least = named.reduce(
      (a, band, i) => (high(band) <= thin && room(i) < room(a) ? i : a),
      named.findIndex((band) => high(band) <= thin),
    );
    named = named.filter((_, i) => i !== least);
  }
}
