import { element } from "../../../panel.ts";
import type { SceneOutline } from "../../../wire/messages.ts";
import { svg } from "../../svg.ts";
import { layersOf } from "../trace.ts";
import { type Draft, round } from "./draft.ts";

const WIDTH = 300;
const HEIGHT = 260;
const TOP = 14;
const LEFT = 40;
const BAND = 120; // px, width of the tissue
const STEP = 0.1; // mm, of the arrow keys; with Shift ten times as much

type Edge = "from" | "to";

/** The tissue in depth, with the place to reach as a band whose edges are dragged, or moved by the arrow keys. */
export class DepthStrip {
  readonly root = element("div", { class: "depth-strip" });
  private draft: Draft | null = null;
  private scene: SceneOutline | null = null;
  private held: Edge | null = null;

  constructor(private readonly moved: (edge: Edge, mm: number) => void) {
    this.root.addEventListener("pointermove", (event) => this.drag(event));
    this.root.addEventListener("pointerup", () => {
      this.held = null;
    });
    this.root.addEventListener("pointercancel", () => {
      this.held = null;
    });
  }

  show(draft: Draft, scene: SceneOutline): void {
    this.draft = draft;
    this.scene = scene;
    const focus = this.root.querySelector<SVGElement>(":focus")?.dataset.edge;
    const { y, face, layers } = this.scale();
    const end = draft.to ?? draft.from + 3;
    const drawing = svg("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: "group", "aria-label": "Depth of the goal" });
    for (const { name, top, bottom } of layers) {
      drawing.append(
        svg("rect", { class: "layer", x: LEFT, y: y(top), width: BAND, height: Math.max(2, y(bottom) - y(top)) }),
        svg("text", { x: LEFT + BAND + 8, y: (y(top) + y(bottom)) / 2 + 4 }, name),
        svg("text", { x: LEFT - 5, y: y(top) + 4, "text-anchor": "end" }, top.toFixed(1)),
      );
    }
    const [low, high] = [y(face + draft.from), y(face + end)];
    drawing.append(
      svg("rect", { class: "goal", x: LEFT - 6, y: low, width: BAND + 12, height: Math.max(2, high - low) }),
      this.handle("from", draft.from, low, "Upper edge of the goal"),
      this.handle("to", end, high, "Lower edge of the goal"),
    );
    this.root.replaceChildren(drawing);
    if (focus) this.root.querySelector<SVGElement>(`[data-edge="${focus}"]`)?.focus();
  }

  private scale(): { y: (mm: number) => number; face: number; layers: Layer[]; perPixel: number } {
    const layers = layersOf(this.scene?.membranes ?? []).map(({ name, top, bottom }) => ({
      name,
      top: top * 1e3,
      bottom: bottom * 1e3,
    }));
    const face = layers.find(({ name }) => name === this.draft?.behind)?.bottom ?? 0;
    const deepest = Math.max(...layers.map(({ bottom }) => bottom), face + (this.draft?.to ?? 0), face + 4) + 3;
    const perPixel = deepest / (HEIGHT - TOP - 6);
    return { y: (mm) => TOP + mm / perPixel, face, layers, perPixel };
  }

  private handle(edge: Edge, mm: number, y: number, label: string): SVGElement {
    const made = svg(
      "g",
      {
        class: "handle",
        role: "slider",
        tabindex: 0,
        "aria-label": label,
        "aria-orientation": "vertical",
        "aria-valuemin": 0,
        "aria-valuemax": 200,
        "aria-valuenow": mm,
        "aria-valuetext": `${mm.toFixed(1)} mm behind the ${this.draft?.behind ?? ""}`,
        "data-edge": edge,
      },
      svg("rect", { class: "touch", x: LEFT - 8, y: y - 22, width: BAND + 16, height: 44 }),
      svg("line", { x1: LEFT - 8, x2: LEFT + BAND + 8, y1: y, y2: y }),
      svg("circle", { cx: LEFT + BAND / 2, cy: y, r: 7 }),
    );
    made.addEventListener("pointerdown", (event) => {
      event.preventDefault();
      const field = document.activeElement;
      if (field instanceof HTMLElement) field.blur(); // what is being typed there counts
      this.root.querySelector<SVGElement>(`[data-edge="${edge}"]`)?.focus();
      this.held = edge;
      this.root.setPointerCapture(event.pointerId);
    });
    made.addEventListener("keydown", (event) => {
      const way = { ArrowDown: 1, ArrowRight: 1, ArrowUp: -1, ArrowLeft: -1 }[event.key];
      if (!way) return;
      event.preventDefault();
      this.moved(edge, round(Math.max(0, mm + way * STEP * (event.shiftKey ? 10 : 1))));
    });
    return made;
  }

  private drag(event: PointerEvent): void {
    const drawing = this.root.querySelector("svg");
    if (!this.held || !drawing) return;
    const box = drawing.getBoundingClientRect();
    this.moved(this.held, this.depthAt(((event.clientY - box.top) / box.height) * HEIGHT));
  }

  /** The depth behind the membrane's far face at this height of the drawing, mm. */
  depthAt(y: number): number {
    const { face, perPixel } = this.scale();
    return round(Math.max(0, (y - TOP) * perPixel - face));
  }
}

interface Layer {
  readonly name: string;
  readonly top: number;
  readonly bottom: number;
}
