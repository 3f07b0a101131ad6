import {
  BackSide,
  BoxGeometry,
  CylinderGeometry,
  DoubleSide,
  Group,
  LatheGeometry,
  Mesh,
  MeshBasicMaterial,
  MeshLambertMaterial,
  Vector2,
} from "three";
import { gaugeOf } from "./needle_gauge.ts";
import type { NeedleLook } from "./needle_look.ts";
import type { Theme } from "./theme.ts";

export const HUB_MM = 9;
export const HUB_RADIUS_MM = 2.9;

/** The hub's outline: pairs of radius and height, from the shaft to the rim, mm. */
export function hubOutline(diameter: number): [number, number][] {
  const neck = Math.max(0.9, diameter * 0.8);
  return [
    [diameter / 2, 0],
    [neck, 0.05],
    [neck * 1.15, 1.2],
    [2.1, 2.4],
    [2.2, HUB_MM - 1],
    [HUB_RADIUS_MM, HUB_MM - 0.9],
    [HUB_RADIUS_MM, HUB_MM],
    [1.7, HUB_MM],
  ];
}

/** Bottom, height and radius of the chamber in the hub, mm. */
export const CHAMBER = { bottom: 2.2, height: HUB_MM - 3.4, radius: 1.6 } as const;

/**
 * The hub behind the shaft: plastic in the colour of the needle's gauge, with a chamber that fills with blood. It
 * is clear if the needle has no gauge.
 */
export class Hub {
  readonly group = new Group();
  private readonly plastic = new MeshLambertMaterial({
    transparent: true,
    opacity: 0.5,
    depthWrite: false,
    side: DoubleSide,
  });
  /** On a dark page, a light wall behind the clear plastic: else the page would show through it, and hide it. */
  private readonly behind = new MeshBasicMaterial({ color: 0xc4c9d1, side: BackSide });
  private readonly blood = new MeshLambertMaterial();
  private readonly body = new Mesh(new LatheGeometry(), this.plastic);
  private readonly back = new Mesh(this.body.geometry, this.behind);
  private readonly wings = new Mesh(new BoxGeometry(17, 5, 0.9), this.plastic);
  private readonly fill = new Mesh(
    new CylinderGeometry(CHAMBER.radius, CHAMBER.radius, 1, 32).translate(0, 0.5, 0),
    this.blood,
  );
  private shade: number | null = null;

  constructor(private readonly theme: Theme) {
    this.body.renderOrder = 3;
    this.wings.renderOrder = 3;
    this.wings.position.y = HUB_MM - 3.5;
    this.wings.add(new Mesh(this.wings.geometry, this.behind));
    this.fill.position.y = CHAMBER.bottom;
    this.group.add(this.back, this.body, this.wings, this.fill);
    this.group.rotation.x = Math.PI / 2; // built along y, placed along the shaft's z
    this.show(0);
    theme.watch(() => this.paint());
  }

  build(diameter: number, look: NeedleLook): void {
    this.body.geometry.dispose();
    this.body.geometry = new LatheGeometry(
      hubOutline(diameter).map(([r, z]) => new Vector2(r, z)),
      40,
    );
    this.back.geometry = this.body.geometry;
    this.wings.visible = look === "tuohy";
    this.shade = gaugeOf(diameter)?.shade ?? null;
    this.paint();
  }

  /** Fills the chamber to a level from 0 to 1. */
  show(level: number): void {
    this.fill.visible = level > 0.01;
    this.fill.scale.y = Math.max(0.01, level * CHAMBER.height);
  }

  private paint(): void {
    const { theme } = this;
    if (this.shade !== null) this.plastic.color.setHex(this.shade);
    else this.plastic.color.copy(theme.color("quiet")).lerp(theme.color("panel"), theme.dark ? 0.1 : 0.35);
    this.behind.visible = theme.dark;
    this.blood.color.copy(theme.color("blood"));
  }
}
