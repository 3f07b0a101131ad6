import { CylinderGeometry, DoubleSide, Group, Mesh, MeshLambertMaterial } from "three";
import type { Theme } from "./theme.ts";

/** Sizes of the syringe, mm: about those of 5 ml. Illustrative. */
export const SYRINGE = { radius: 6.5, length: 46, bore: 5.9, travel: 30, rod: 2.4, rest: 7.5 } as const;

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
  private readonly fluid = new Mesh(new CylinderGeometry(SYRINGE.bore, SYRINGE.bore, 1, 32), this.saline);
  private readonly plunger = new Group();

  constructor(theme: Theme) {
    const { radius, length, bore, rod, rest } = SYRINGE;
    const tube = (r: number, long: number, at: number, material: MeshLambertMaterial, open = false): Mesh => {
      const made = new Mesh(new CylinderGeometry(r, r, long, 32, 1, open).translate(0, at + long / 2, 0), material);
      if (material.transparent) made.renderOrder = 3;
      return made;
    };
    this.plunger.add(
      tube(bore, 4, 0, this.rubber),
      tube(rod, length + 6, 4, this.solid),
      tube(rest, 1.6, length + 10, this.solid),
    );
    this.fluid.renderOrder = 2;
    this.group.add(
      tube(2.2, 5, 0, this.glass),
      tube(radius, length, 5, this.glass, true),
      tube(radius + 4, 1.2, length + 5, this.glass),
      this.fluid,
      this.plunger,
    );
    this.show(0);
    theme.watch(() => {
      this.glass.color.copy(theme.color("quiet")).lerp(theme.color("panel"), 0.5);
      this.saline.color.copy(theme.color("accent"));
      this.solid.color.copy(theme.color("panel")).lerp(theme.color("quiet"), 0.25);
      this.rubber.color.copy(theme.color("text")).lerp(theme.color("quiet"), 0.5);
    });
  }

  /** pressed: share of the plunger's travel, from 0 to 1. */
  show(pressed: number): void {
    const left = SYRINGE.travel * (1 - pressed) + 0.5;
    this.plunger.position.y = 5 + left;
    this.fluid.scale.y = left;
    this.fluid.position.y = 5 + left / 2;
  }
}
