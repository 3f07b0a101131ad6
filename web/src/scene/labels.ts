import type { Camera, Vector3 } from "three";
import { element } from "../panel.ts";
import { type Place, placeLabels, type Rect, type Wish } from "./label_places.ts";

const SVG = "http://www.w3.org/2000/svg";
/** Parts of the view that labels do not cover. */
const OBSTACLES =
  ".view-tools, .view-help, .view-sentence, .view-coarser, .view-moment, " +
  ".scale-bar, .hub-inset, .pop-words, .thumb-button";
const MEASURE_MS = 400;

interface Label {
  readonly node: HTMLElement;
  readonly line: SVGLineElement;
  text: string;
  width: number;
  height: number;
}

/** Text labels in the view, as HTML: sharp, and readable for screen readers. Lines lead to what they name. */
export class Labels {
  private readonly layer = element("div", { class: "view-labels" });
  private readonly lines = document.createElementNS(SVG, "svg");
  private readonly known = new Map<string, Label>();
  private wishes: Wish[] = [];
  private size: readonly [number, number] = [1, 1];
  private obstacles: Rect[] = [];
  private measured = Number.NEGATIVE_INFINITY;
  private later = 0; // timer of the next measurement; 0 if none is due
  private readonly watched = new WeakSet<Element>();
  /** Places the labels again when a button or a note comes, goes or changes its size. */
  private readonly watch = new ResizeObserver(() => this.again());

  constructor(private readonly host: HTMLElement) {
    this.lines.setAttribute("aria-hidden", "true");
    this.layer.append(this.lines);
    host.append(this.layer);
  }

  begin(): void {
    this.wishes = [];
  }

  /** Asks for a label at `at`, mm: right or left of it, or in the column next to the tissue, with a line to it. */
  put(
    id: string,
    text: string,
    kind: string,
    at: Vector3,
    camera: Camera,
    size: readonly [number, number],
    how: "right" | "left" | "column" = "right",
  ): void {
    const on = at.clone().project(camera);
    if (on.z > 1) return;
    this.size = size;
    const label = this.labelOf(id, kind);
    if (label.text !== text || label.width === 0) {
      const asWide = label.width > 0 && label.text.length === text.length; // only digits have changed
      label.text = text;
      label.node.textContent = text;
      if (!asWide) {
        label.node.hidden = false;
        label.width = label.node.offsetWidth;
        label.height = label.node.offsetHeight;
      }
    }
    const x = Math.max(0, Math.min(((on.x + 1) / 2) * size[0], size[0]));
    const y = Math.max(0, Math.min(((1 - on.y) / 2) * size[1], size[1]));
    this.wishes.push({ id, width: label.width, height: label.height, x, y, how });
  }

  end(): void {
    this.measure();
    const places = new Map(placeLabels(this.wishes, this.size[0], this.size[1], this.obstacles).map((p) => [p.id, p]));
    const points = new Map(this.wishes.map((wish) => [wish.id, wish]));
    for (const [id, label] of this.known) {
      const place = places.get(id);
      label.node.hidden = !place;
      label.line.style.display = place?.line ? "" : "none";
      if (place) this.show(label, place, points.get(id)!);
    }
  }

  /** Removes all labels, for another scene. */
  clear(): void {
    for (const { node, line } of this.known.values()) {
      node.remove();
      line.remove();
    }
    this.known.clear();
    this.wishes = [];
  }

  private show({ node, line }: Label, place: Place, { x, y }: Wish): void {
    node.style.transform = `translate(${place.left.toFixed(1)}px, ${place.top.toFixed(1)}px)`;
    if (!place.line) return;
    const ends = { x1: place.line[0], y1: place.line[1], x2: x, y2: y };
    for (const [name, value] of Object.entries(ends)) line.setAttribute(name, value.toFixed(1));
  }

  private labelOf(id: string, kind: string): Label {
    let label = this.known.get(id);
    if (!label) {
      const line = document.createElementNS(SVG, "line");
      line.setAttribute("class", kind);
      label = { node: element("span", { class: `view-label ${kind}` }), line, text: "", width: 0, height: 0 };
      this.known.set(id, label);
      this.lines.append(line);
      this.layer.append(label.node);
    }
    return label;
  }

  private again(): void {
    this.measured = Number.NEGATIVE_INFINITY;
    if (this.wishes.length > 0) this.end();
  }

  /**
   * Reads the places of buttons and notes and the sizes of labels, at most once in MEASURE_MS. After the last picture,
   * and after each change, it reads them once more: a button may move later, when no picture is drawn any more.
   */
  private measure(): void {
    const now = performance.now();
    const due = now - this.measured >= MEASURE_MS;
    if (due) this.measured = now;
    const changed = due && this.read();
    if ((changed || !due) && !this.later)
      this.later = window.setTimeout(() => {
        this.later = 0;
        this.again();
      }, MEASURE_MS);
  }

  /** Returns whether an obstacle or the size of a label has changed. */
  private read(): boolean {
    const before = JSON.stringify([this.obstacles, this.wishes.map(({ id, width, height }) => [id, width, height])]);
    const from = this.host.getBoundingClientRect();
    this.obstacles = [...this.host.querySelectorAll<HTMLElement>(OBSTACLES)].flatMap((node) => {
      if (!this.watched.has(node)) this.watch.observe(node);
      this.watched.add(node);
      const { left, top, right, bottom } = node.getBoundingClientRect();
      if (right <= left || bottom <= top) return [];
      return [{ left: left - from.left, top: top - from.top, right: right - from.left, bottom: bottom - from.top }];
    });
    for (const label of this.known.values()) {
      if (label.node.hidden) continue;
      label.width = label.node.offsetWidth;
      label.height = label.node.offsetHeight;
    }
    this.wishes = this.wishes.map((wish) => {
      const label = this.known.get(wish.id);
      return label ? { ...wish, width: label.width, height: label.height } : wish;
    });
    return before !== JSON.stringify([this.obstacles, this.wishes.map(({ id, width, height }) => [id, width, height])]);
  }
}
