import { CylinderGeometry, DoubleSide, Group, LatheGeometry, Mesh, MeshLambertMaterial, Vector2 } from "three";
import type { Theme } from "./theme.ts";

const LENGTH = 9;
const FLOW_MS = 350;

/** The hub behind the shaft: clear plastic with a chamber that fills with blood while the tip is in the lumen. mm. */
export class Hub {
  readonly group = new Group();
  private readonly plastic = new MeshLambertMaterial({
    transparent: true,
    opacity: 0.42,
    depthWrite: false,
    side: DoubleSide,
  });
  private readonly blood = new MeshLambertMaterial();
  private readonly body = new Mesh(new LatheGeometry(), this.plastic);
  private readonly fill = new Mesh(new CylinderGeometry(1.6, 1.6, 1, 32).translate(0, 0.5, 0), this.blood);
  private level = 0;

  constructor(theme: Theme) {
    this.body.renderOrder = 3;
    this.fill.position.y = 2.2;
    this.fill.visible = false;
    this.group.add(this.body, this.fill);
    this.group.rotation.x = Math.PI / 2; // built along y, placed along the shaft's z
    theme.watch(() => {
      this.plastic.color.copy(theme.color("quiet")).lerp(theme.color("panel"), theme.dark ? 0.1 : 0.35);
      this.blood.color.copy(theme.color("blood"));
    });
  }

  build(diameter: number): void {
    const neck = Math.max(0.9, diameter * 0.8);
    // Pairs of radius and height, from the shaft to the rim.
    const profile: [number, number][] = [
      [diameter / 2, 0],
      [neck, 0.05],
      [neck * 1.15, 1.2],
      [2.1, 2.4],
      [2.2, LENGTH - 1],
      [2.9, LENGTH - 0.9],
      [2.9, LENGTH],
      [1.7, LENGTH],
    ];
    this.body.geometry.dispose();
    this.body.geometry = new LatheGeometry(
      profile.map(([r, z]) => new Vector2(r, z)),
      40,
    );
  }

  /** Fills while `inLumen`, and drains more slowly. Returns whether the level changed. */
  step(inLumen: boolean, elapsedMs: number): boolean {
    const goal = inLumen ? 1 : 0;
    if (this.level === goal) return false;
    const part = 1 - Math.exp(-elapsedMs / (inLumen ? FLOW_MS : 4 * FLOW_MS));
    this.level += part * (goal - this.level);
    if (Math.abs(goal - this.level) < 0.01) this.level = goal;
    this.fill.visible = this.level > 0.01;
    this.fill.scale.y = Math.max(0.01, this.level * (LENGTH - 3.4));
    return true;
  }
}
