import { element } from "../panel.ts";
import { CHAMBER, HUB_MM, hubOutline } from "./hub.ts";
import type { NeedleState } from "./needle.ts";
import { gaugeOf } from "./needle_gauge.ts";
import { syringeParts } from "./needle_syringe.ts";

const SVG = "http://www.w3.org/2000/svg";
/** The words under the inset. */
export function insetWords({ look, blood, pressed, content, plunger }: NeedleState): string {
  if (look !== "tuohy") return blood > 0.05 ? "Hub: blood" : "Hub: no blood";
  if (pressed >= 1) return "Syringe: empty";
  if (plunger) return { free: "Plunger: not pushed", held: "Plunger: holds", moves: "Plunger: gives way" }[plunger];
  if (pressed > 0 && content !== "tissue") return "Plunger: gives way";
  return content === "outside" ? "Plunger: out" : "Plunger: holds";
}

/**
 * A round magnifier that shows the hub while the hub is out of view: flash-back and the plunger are always seen.
 * The returned function updates it; null hides it.
 */
export function hubInset(host: HTMLElement): (state: NeedleState | null) => void {
  const words = element("span", { class: "hub-inset-words", role: "status" });
  const picture = document.createElementNS(SVG, "svg");
  picture.setAttribute("viewBox", "-8 -8 16 16");
  picture.setAttribute("aria-hidden", "true"); // the words say what it shows
  const box = element("div", { class: "hub-inset", hidden: true }, words);
  box.prepend(picture);
  host.append(box);
  let last = "";
  return (state) => {
    box.hidden = state === null;
    if (!state) return;
    const { look, diameter, blood, pressed, syringe: size } = state;
    const key = `${look} ${diameter} ${blood.toFixed(2)} ${pressed.toFixed(3)} ${size.bore} ${size.travel}`;
    if (key !== last) {
      last = key;
      picture.replaceChildren(...(look === "tuohy" ? syringe(state) : hub(state)));
    }
    const text = insetWords(state);
    if (words.textContent !== text) words.textContent = text;
  };
}

function shape(name: string, attributes: Readonly<Record<string, string | number>>): SVGElement {
  const made = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, String(value));
  return made;
}

const box = (kind: string, left: number, top: number, width: number, height: number): SVGElement =>
  shape("rect", { class: kind, x: left, y: top, width, height });

/** The hub from the side, in mm: the shaft points down. */
function hub({ diameter, blood }: NeedleState): SVGElement[] {
  const foot = HUB_MM / 2;
  const outline = hubOutline(diameter);
  const points = [...outline, ...outline.map(([r, z]) => [-r, z] as const).reverse()];
  const body = shape("polygon", { points: points.map(([r, z]) => `${r},${foot - z}`).join(" "), class: "hub-body" });
  const shade = gaugeOf(diameter)?.shade;
  if (shade !== undefined) body.style.fill = `#${shade.toString(16).padStart(6, "0")}`;
  const { bottom, height, radius } = CHAMBER;
  const level = blood * height;
  return [
    box("hub-steel", -diameter / 2, foot, diameter, 8),
    body,
    box("hub-chamber", -radius, foot - bottom - height, 2 * radius, height),
    box("hub-blood", -radius, foot - bottom - level, 2 * radius, level),
  ];
}

/** The syringe from the side, drawn smaller. */
function syringe({ diameter, pressed, syringe: size }: NeedleState): SVGElement[] {
  const { bore, travel } = size;
  const { radius, length, rod, rest } = syringeParts(size);
  const scale = 14 / (length + 20);
  const left = travel * (1 - pressed);
  const group = shape("g", { transform: `translate(0 7) scale(${scale})` });
  const shade = gaugeOf(diameter)?.shade;
  const foot = box("hub-body", -2.9, -9, 5.8, 9);
  if (shade !== undefined) foot.style.fill = `#${shade.toString(16).padStart(6, "0")}`;
  group.append(
    box("hub-steel", -diameter / 2, 0, diameter, 8),
    foot,
    box("hub-chamber", -radius, -9 - length, 2 * radius, length),
    box("hub-saline", -bore, -9 - left, 2 * bore, left),
    box("hub-rubber", -bore, -13 - left, 2 * bore, 4),
    box("hub-rod", -rod, -13 - left - length, 2 * rod, length),
    box("hub-rod", -rest, -15 - left - length, 2 * rest, 2),
  );
  return [group];
}
