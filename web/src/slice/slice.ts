import type { Vector3 } from "three";
import { mm } from "../format.ts";
import { element, everyFrame } from "../panel.ts";
import { DepthScale, framingOf } from "../scene/framing.ts";
import { Moment } from "../scene/moment.ts";
import { type Probe, placeAtNeedle, planeOf, type SkinFrame, skinFrame } from "../scene/probe.ts";
import type { App } from "../state/app.ts";
import type { SceneView } from "../wire/messages.ts";
import { PROBE_KEYS, probeButtons, probeDrag, probeKeys, probeSliders, Quality } from "./controls.ts";
import { type Dents, displaced } from "./dents.ts";
import { Drawing, type Shown } from "./drawing.ts";
import type { Tissue } from "./layers.ts";
import type { NeedleSpan } from "./needle_span.ts";

const MARK = "Drawing, not a simulation of an ultrasound instrument";
const AHEAD = 0.2; // of the picture's depth: the tissue that the needle goes to is in the picture
const INTERVAL_MS = 30; // between two pictures
const WORDS_MS = 500;
const SHARPEST = 2; // device pixels per CSS pixel, along each side

/**
 * The slice: a picture like that of ultrasound, drawn from the same moment as the 3-D view. follows: whether the probe
 * goes with a needle that leaves the middle of the picture.
 */
export function slice(host: HTMLElement, app: App, probe: Probe, close: () => void, follows: () => boolean): void {
  const canvas = element("canvas", {
    tabindex: 0, role: "application", "aria-label": `Slice through the tissue. ${MARK}`,
    "aria-describedby": "slice-words slice-help",
  }); // biome-ignore format: short
  const less = element("p", { class: "slice-less", role: "status", hidden: true }, "Less detail, to keep up");
  const mark = element("p", { class: "slice-mark" }, MARK);
  const words = element("p", { class: "slice-words", id: "slice-words" });
  const help = element("p", { class: "only-read", id: "slice-help" }, PROBE_KEYS);

  const moment = new Moment();
  const quality = new Quality();
  let built: { scene: SceneView; skin: SkinFrame; drawing: Drawing } | null = null;
  let shown: Shown | null = null;
  let drawn = "";
  let drawnAt = 0;
  let describedAt = 0;
  let size = { width: 0, height: 0 };

  const toNeedle = (across: boolean): void => {
    if (!built) return;
    const ahead = AHEAD * built.drawing.depth;
    probe.place.value = placeAtNeedle(built.skin, moment.tip, moment.axis, across, probe.place.value, ahead);
  };
  const picture = element("div", { class: "slice-picture" }, canvas, less, mark);
  host.append(probeButtons(toNeedle, close), picture, words, probeSliders(probe), help);
  probeKeys(canvas, probe, () => toNeedle(false));
  probeDrag(canvas, probe, () => 1 / (shown?.frame.scale ?? 10));
  new ResizeObserver(() => {
    size = { width: picture.clientWidth, height: picture.clientHeight };
    const ratio = Math.min(SHARPEST, window.devicePixelRatio || 1);
    canvas.width = Math.max(1, Math.round(size.width * ratio));
    canvas.height = Math.max(1, Math.round(size.height * ratio));
    drawn = "";
  }).observe(picture);

  /** On the stage, the curve beside the picture has the same heights. */
  const framing = framingOf(app);
  const tellDepths = ({ depth, y }: Shown["frame"]): void => {
    const top = canvas.getBoundingClientRect().top - host.parentElement!.getBoundingClientRect().top;
    const depths = new DepthScale(top, top + y(depth / 2), top + y(depth), depth);
    if (!depths.equals(framing.depths.value)) framing.depths.value = depths;
  };

  const build = (scene: SceneView): void => {
    const first = built === null;
    const skin = skinFrame(scene);
    built = { scene, skin, drawing: new Drawing(scene, skin) };
    drawn = "";
    if (first) toNeedle(false);
  };

  everyFrame((now) => {
    const source = app.source.value;
    const scene = source.scene.value;
    if (host.hidden || !scene || now - drawnAt < INTERVAL_MS || size.width < 20 || size.height < 20) return;
    if (source.history.membranes !== scene.membranes.length || !moment.read(source)) return;
    if (scene !== built?.scene) build(scene);
    if (follows() && built && leaves(built.skin, moment.tip, probe)) toNeedle(false);
    const place = probe.place.value;
    const key = keyOf(moment, [place.x, place.z, place.turn, quality.level]);
    if (key !== drawn && built) {
      drawn = key;
      drawnAt = now;
      const before = performance.now();
      shown = built.drawing.draw(canvas, size.width, size.height, moment, place, quality.pixels);
      if (shown) probe.picture.value = samePicture(probe.picture.value, shown.frame);
      if (shown && follows()) tellDepths(shown.frame);
      if (quality.judge(performance.now() - before)) less.hidden = quality.level === 0;
    }
    if (shown && now - describedAt > WORDS_MS) {
      describedAt = now;
      const text = pictureWords(shown.span, shown.tissue, shown.dents);
      if (words.textContent !== text) words.textContent = text;
    }
  });
}

/** The values that the picture depends on, rounded to invisible steps. */
function keyOf({ tip, axis, membranes }: Moment, other: readonly number[]): string {
  const round = (values: readonly number[], step: number): string => values.map((v) => Math.round(v / step)).join();
  const proxies = membranes.map(({ phase, proxy }) => `${phase}:${round(proxy.toArray(), 0.02)}`).join();
  return `${round(tip.toArray(), 0.02)} ${round(axis.toArray(), 0.004)} ${round(other, 1e-3)} ${proxies}`;
}

/** Whether the tip is outside the middle half of the picture. */
function leaves(skin: SkinFrame, tip: Vector3, { place, picture }: Probe): boolean {
  const { origin, along } = planeOf(skin, place.value);
  return picture.value !== null && Math.abs(tip.clone().sub(origin).dot(along)) > picture.value.width / 4;
}

/** The same object while the size stays, so that nobody is told of a change that is none. */
function samePicture(
  before: { width: number; depth: number } | null,
  { width, depth }: { width: number; depth: number },
): { width: number; depth: number } {
  return before && before.width === width && before.depth === depth ? before : { width, depth };
}

/** The picture in words. */
function pictureWords(span: NeedleSpan | null, tissue: Tissue, dents: Dents): string {
  const words = [needleWords(span)];
  if (tissue.vessel) words.push(`The vein is ${mm(lumenHeight(tissue, dents) / 1000, 1)} high at the needle.`);
  if (dents.most > 0.2) words.push(`The needle displaces the tissue by ${mm(dents.most / 1000, 1)}.`);
  return words.join(" ");
}

function needleWords(span: NeedleSpan | null): string {
  if (!span) return "The needle is not in this slice.";
  const { deep, shallow, tip, along } = span;
  const where = `${mm(deep.depth / 1000, 1)} deep`;
  if (tip) return `The needle ${along ? "lies in" : "crosses"} the slice: the tip is ${where}.`;
  if (along) return `The shaft lies in the slice down to ${mm(deep.depth / 1000, 1)}; the tip does not.`;
  return `The shaft crosses the slice ${mm((deep.depth + shallow.depth) / 2000, 1)} deep.`;
}

/** Height of the lumen on the needle's line, mm. */
export function lumenHeight({ vessel }: Tissue, dents: Dents): number {
  if (!vessel) return 0;
  const { depth, radius } = vessel;
  return Math.max(0, displaced(depth + radius, dents) - displaced(depth - radius, dents));
}
