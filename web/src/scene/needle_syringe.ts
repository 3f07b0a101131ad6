import { CylinderGeometry, DoubleSide, Group, Mesh, MeshLambertMaterial } from "three";
import type { SceneView } from "../wire/messages.ts";
import { MM } from "./moment.ts";
import type { Theme } from "./theme.ts";

/** mm. bore: inner radius of the barrel. travel: the plunger's way from full to empty. */
export interface SyringeSize {
  readonly bore: number;
  readonly travel: number;
}

/** The picture's own syringe, in a scene without one: about 3 ml of saline in a syringe of 5 ml. Illustrative. */
const OWN: SyringeSize = { bore: 5.9, travel: 30 };

/** The size of a scene's syringe, or of the picture's own. */
export function syringeSize({ syringe }: Pick<SceneView, "syringe">): SyringeSize {
  if (!syringe) return OWN;
  const bore = syringe.bore / 2;
  return { bore: bore * MM, travel: (syringe.volume / (Math.PI * bore ** 2)) * MM };
}

/** The other sizes, mm: radii of the barrel, the rod and the thumb rest, and the barrel's length. Illustrative. */
export const syringeParts = ({ bore, travel }: SyringeSize) =>
  ({ radius: bore + 0.6, length: travel + 16, rod: 0.4 * bore, rest: bore + 1.6 }) as const;

const NOZZLE = 5;
const FLANGE = 4; // beyond the barrel
const STALK = 11.6; // of the plunger, from the barrel's length to the end of the thumb rest

/** How far a full syringe reaches behind its nozzle, and to the side, mm. */
export function syringeReach(size: SyringeSize): { length: number; radius: number } {
  const { radius, length, rest } = syringeParts(size);
  return { length: NOZZLE + size.travel + length + STALK, radius: Math.max(radius + FLANGE, rest) };
}

/** A syringe of saline on the hub, for the loss of resistance. Its plunger moves in by a share of its travel. */
export class Syringe {
  readonly group = new Group();
  private readonly glass = new MeshLambertMaterial({
    transparent: true,
    opacity: 0.22,
    depthWrite: false,
    side: DoubleSide,
  });
  private readonly saline = new MeshLambertMaterial({ transparent: true, opacity: 0.35, depthWrite: false });
  private readonly solid = new MeshLambertMaterial();
  private readonly rubber = new MeshLambertMaterial();
  private readonly fluid = new Mesh(undefined, this.saline);
  private readonly plunger = new Group();
  private travel = 0;

  constructor(theme: Theme) {
    this.fluid.renderOrder = 2;
    theme.watch(() => {
      // On a dark page, glass and rod are light and the rubber is dark, as on a light one.
      const [light, dark] = theme.dark ? ["text", "page"] : ["panel", "text"];
      this.glass.color.copy(theme.color("quiet")).lerp(theme.color(light!), 0.5);
      this.glass.opacity = theme.dark ? 0.3 : 0.22;
      this.saline.color.copy(theme.color("accent"));
      this.solid.color.copy(theme.color(light!)).lerp(theme.color("quiet"), theme.dark ? 0.5 : 0.25);
      this.rubber.color.copy(theme.color(dark!)).lerp(theme.color("quiet"), theme.dark ? 0.3 : 0.5);
    });
  }

  /** Builds it anew, full. */
  build(size: SyringeSize): void {
    const { bore } = size;
    const { radius, length, rod, rest } = syringeParts(size);
    for (const part of [...this.group.children, ...this.plunger.children]) {
      if (part instanceof Mesh) part.geometry.dispose();
    }
    this.group.clear();
    this.plunger.clear();
    this.travel = size.travel;
    this.fluid.geometry = new CylinderGeometry(bore, bore, 1, 32);
    const tube = (r: number, long: number, at: number, material: MeshLambertMaterial, open = false): Mesh => {
      const made = new Mesh(new CylinderGeometry(r, r, long, 32, 1, open).translate(0, at + long / 2, 0), material);
      if (material.transparent) made.renderOrder = 3;
      return made;
    };
    this.plunger.add(
      tube(bore, 4, 0, this.rubber),
      tube(rod, length + 6, 4, this.solid),
      tube(rest, 1.6, length + STALK - 1.6, this.solid),
    );
    this.group.add(
      tube(2.2, NOZZLE, 0, this.glass),
      tube(radius, length, NOZZLE, this.glass, true),
      tube(radius + FLANGE, 1.2, length + NOZZLE, this.glass),
      this.fluid,
      this.plunger,
    );
    this.show(0);
  }

  /** pressed: share of the plunger's travel, from 0 to 1. */
  show(pressed: number): void {
    const left = this.travel * (1 - pressed);
    this.fluid.visible = left > 0;
    this.plunger.position.y = NOZZLE + left;
    this.fluid.scale.y = Math.max(left, 1e-6); // a matrix of 0 has no inverse
    this.fluid.position.y = NOZZLE + left / 2;
  }
}
