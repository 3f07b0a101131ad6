import type { Camera, Vector3 } from "three";
import { element } from "../panel.ts";

const LINE_PX = 18;

/** Text labels in the view, as HTML: sharp, and readable for screen readers. They avoid overlaps. */
export class Labels {
  private readonly layer = element("div", { class: "view-labels" });
  private readonly known = new Map<string, { node: HTMLElement; text: string; width: number }>();
  private readonly placed: { id: string; x: number; y: number; column: boolean }[] = [];

  constructor(host: HTMLElement) {
    host.append(this.layer);
  }

  begin(): void {
    this.placed.length = 0;
  }

  /** Places a label at `at`, mm: right or left of it, or in the column next to the slabs, where labels move apart. */
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
    let label = this.known.get(id);
    if (!label) {
      label = { node: element("span", { class: `view-label ${kind}` }), text: "", width: 0 };
      this.known.set(id, label);
      this.layer.append(label.node);
    }
    if (label.text !== text) {
      label.text = text;
      label.node.textContent = text;
      label.width = label.node.offsetWidth;
    }
    const beside = how === "left" ? -label.width - 10 : 8;
    const x = Math.min(((on.x + 1) / 2) * size[0] + beside, size[0] - label.width - 8);
    this.placed.push({ id, x: Math.max(8, x), y: ((1 - on.y) / 2) * size[1], column: how === "column" });
  }

  end(): void {
    const column = this.placed.filter((label) => label.column).sort((a, b) => a.y - b.y);
    for (let pass = 0; pass < 4; pass++) {
      for (let i = 1; i < column.length; i++) {
        const above = column[i - 1]!;
        const below = column[i]!;
        const apart = (LINE_PX - (below.y - above.y)) / 2;
        if (apart > 0 && Math.abs(above.x - below.x) < 140) {
          above.y -= apart;
          below.y += apart;
        }
      }
    }
    for (const label of this.known.values()) label.node.hidden = true;
    for (const { id, x, y } of this.placed) {
      const { node } = this.known.get(id)!;
      node.hidden = false;
      node.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px) translateY(-50%)`;
    }
  }

  /** Removes all labels, for another scene. */
  clear(): void {
    for (const { node } of this.known.values()) node.remove();
    this.known.clear();
    this.placed.length = 0;
  }
}
