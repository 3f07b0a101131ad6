import { type Camera, Vector3 } from "three";
import { element } from "../panel.ts";
import { popLabel } from "../plots/marks.ts";
import { ringOf } from "../pop/ring.ts";
import type { Source } from "../state/source.ts";
import type { SceneView } from "../wire/messages.ts";
import { MM } from "./moment.ts";

const CORNERS = 48;
const SVG = "http://www.w3.org/2000/svg";

/** width, height: of the view, px. free: the right end of what nothing covers, px. */
type DrawRing = (source: Source, scene: SceneView, camera: Camera, width: number, height: number, free: number) => void;

/** Draws a ring on the membrane, around the needle, when it pops, with the drop of the force. */
export function popRing(host: HTMLElement): DrawRing {
  const still = matchMedia("(prefers-reduced-motion: reduce)");
  const layer = document.createElementNS(SVG, "svg");
  layer.setAttribute("class", "pop-ring");
  layer.setAttribute("aria-hidden", "true"); // the list of events speaks the pop
  // A halo as a line of its own: a filter over the whole view is slow without a graphics card.
  const lines = ["halo", "ring"].map((name) => {
    const line = document.createElementNS(SVG, "path");
    line.setAttribute("class", name);
    return line;
  });
  layer.append(...lines);
  const words = element("span", { class: "view-label pop-words", "aria-hidden": "true", hidden: true });
  host.append(layer, words);
  let drawn = "";
  let wide = 0; // px, of the words
  const hide = (): void => {
    if (drawn === "") return;
    drawn = "";
    layer.style.display = "none";
    words.hidden = true;
  };
  hide();
  layer.style.display = "none";
  return (source, scene, camera, width, height, free) => {
    const ring = ringOf(source, still.matches);
    const at = ring && hole(source, ring.event.tick, ring.event.membrane);
    const normal = ring && scene.membranes[ring.event.membrane]?.inward_normal;
    if (!ring || !at || !normal) return hide();
    const radius = (ring.radius * scene.diameter * MM) / 2;
    const points = circle(at, new Vector3(...normal), radius).map((point) => {
      const on = point.project(camera);
      return [((on.x + 1) / 2) * width, ((1 - on.y) / 2) * height] as const;
    });
    const d = `M${points.map(([x, y]) => `${x.toFixed(1)} ${y.toFixed(1)}`).join("L")}Z`;
    if (d + ring.alpha === drawn) return;
    drawn = d + ring.alpha;
    for (const line of lines) line.setAttribute("d", d);
    layer.style.opacity = ring.alpha.toFixed(2);
    layer.style.display = "";
    const text = popLabel(ring.event, source.history);
    words.hidden = false;
    if (words.textContent !== text) {
      words.textContent = text;
      wide = words.offsetWidth;
    }
    const right = Math.max(...points.map(([x]) => x));
    const top = Math.min(...points.map(([, y]) => y));
    const x = Math.max(8, Math.min(right + 4, free - wide - 8));
    words.style.transform = `translate(${x.toFixed(1)}px, ${Math.max(4, top - 20).toFixed(1)}px)`;
  };
}

/** The place on the undeformed front face where the needle is in the membrane, mm; null outside. */
function hole({ history }: Source, tick: number, membrane: number): Vector3 | null {
  const direction = new Vector3().fromArray(history.row("direction", tick), 3 * membrane);
  const depth = history.row("depth", tick)[membrane]!;
  if (!(direction.lengthSq() > 0.5) || !Number.isFinite(depth)) return null;
  const proxy = new Vector3().fromArray(history.row("proxy", tick), 3 * membrane);
  return proxy.addScaledVector(direction, -depth).multiplyScalar(MM);
}

function circle(centre: Vector3, normal: Vector3, radius: number): Vector3[] {
  const side = new Vector3(1, 0, 0);
  if (Math.abs(normal.x) > 0.9) side.set(0, 0, 1);
  const u = side.addScaledVector(normal, -side.dot(normal)).normalize();
  const v = new Vector3().crossVectors(normal, u);
  return Array.from({ length: CORNERS }, (_, i) => {
    const angle = (2 * Math.PI * i) / CORNERS;
    return centre
      .clone()
      .addScaledVector(u, radius * Math.cos(angle))
      .addScaledVector(v, radius * Math.sin(angle));
  });
}
