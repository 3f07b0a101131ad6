import {
  type Camera,
  Color,
  CylinderGeometry,
  Group,
  InstancedMesh,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  MeshLambertMaterial,
  Vector3,
} from "three";
import type { Source } from "../state/source.ts";
import type { LawCurve, SceneView } from "../wire/messages.ts";
import { placeNeedle } from "./bevel.ts";
import { HUB_MM, HUB_RADIUS_MM, Hub } from "./hub.ts";
import { MM, Moment } from "./moment.ts";
import { Level } from "./needle_level.ts";
import { type NeedleLook, needleLook, tipOffset } from "./needle_look.ts";
import { faceShape, shaftShape } from "./needle_shape.ts";
import { atTip, type Content } from "./needle_space.ts";
import { Syringe, type SyringeSize, syringeReach, syringeSize } from "./needle_syringe.ts";
import { outOfView } from "./out_of_view.ts";
import { steel } from "./steel.ts";
import type { Theme } from "./theme.ts";

const EMPTY = new Color(0x23272d);
const MARK_EVERY_MM = 10;
const MOST_MARKS = 12;
/** Shares of the way left, per second, and the plunger's whole way per second. Illustrative. */
const FILLS = 2.9;
const DRAINS = 0.7;
const YIELDS = 1.1;
/** A level forgets what was so long ago; steps between two ticks of it. s */
const LASTS = 6;
const STEP = 0.1;

const ALONG = Math.cos(Math.PI / 9);

/** Spaces into which the syringe empties. */
const YIELDING: ReadonlySet<Content> = new Set(["epidural space", "cerebrospinal fluid"]);

const PUSHES = 0.2; // N; a thumb that only touches the plunger does not push it
const MOVES = 0.5; // mm/s

/** What the thumb does to the plunger of a scene's syringe; null without one. */
export type Plunger = "free" | "held" | "moves" | null;

export function plungerOf({ plunger, plungerSpeed, thumbForce }: Moment): Plunger {
  if (!Number.isFinite(plunger)) return null;
  if (!(thumbForce > PUSHES)) return "free";
  return plungerSpeed > MOVES ? "moves" : "held";
}

/** What the hub and the syringe show. */
export interface NeedleState {
  readonly look: NeedleLook;
  /** Outer diameter, mm. */
  readonly diameter: number;
  /** Levels from 0 to 1: of the blood in the hub, and of the plunger's way. */
  readonly blood: number;
  readonly pressed: number;
  readonly plunger: Plunger;
  readonly syringe: SyringeSize;
  /** What the tip is in. */
  readonly content: Content;
}

/** The share of its way that the plunger has moved. A syringe that holds nothing is pressed in from the start. */
const shareOf = (moved: number, travel: number): number => (travel > 0 ? Math.min(1, Math.max(0, moved / travel)) : 1);

/** The scene's needle with its true diameter and tip angle. The view chooses the length. mm, rad. */
export class Needle {
  readonly group = new Group();
  private readonly mouth = new MeshLambertMaterial();
  private readonly shaft = new Mesh(undefined, steel(0.92));
  private readonly face = new Mesh(undefined, steel(1.15));
  private readonly bore = new Mesh(undefined, this.mouth);
  private readonly marks = new InstancedMesh(
    new CylinderGeometry(0.5, 0.5, 1, 32, 1, true).rotateX(Math.PI / 2),
    new MeshBasicMaterial({ color: 0x30343a }),
    MOST_MARKS,
  );
  private readonly hub: Hub;
  private readonly syringe: Syringe;
  private readonly blood = new Level();
  private readonly past = new Moment();
  private readonly pressed = new Level();
  private readonly middle = new Vector3();
  private readonly ahead = new Vector3();
  private readonly axis = new Vector3(0, -1, 0);
  private look: NeedleLook = "hypodermic";
  private diameter = 1;
  private content: Content = "outside";
  private plunger: Plunger = null;
  private size: SyringeSize = { bore: 1, travel: 0 };
  private length = 1; // of the shaft

  constructor(private readonly theme: Theme) {
    this.hub = new Hub(theme);
    this.syringe = new Syringe(theme);
    this.hub.group.add(this.syringe.group);
    this.syringe.group.position.y = HUB_MM - 1;
    this.group.matrixAutoUpdate = false;
    this.group.add(this.shaft, this.face, this.bore, this.marks, this.hub.group);
  }

  build(scene: SceneView, length: number): void {
    const diameter = scene.diameter * MM;
    const tipLength = scene.tip_length * MM;
    this.look = needleLook(scene);
    this.diameter = diameter;
    this.length = length;
    for (const { geometry } of [this.shaft, this.face, this.bore]) geometry.dispose();
    this.shaft.geometry = shaftShape(diameter, tipLength, length, this.look);
    this.face.geometry = faceShape(diameter, tipLength, false, this.look);
    this.bore.geometry = faceShape(diameter, tipLength, true, this.look);
    this.hub.build(diameter, this.look);
    const middle = tipOffset(this.look) * diameter;
    this.hub.group.position.set(middle, 0, length);
    this.size = syringeSize(scene);
    this.syringe.build(this.size);
    this.syringe.show(this.pressed.value);
    this.syringe.group.visible = this.look === "tuohy";
    this.mark(middle, length);
  }

  place(tip: Vector3, axis: Vector3): void {
    this.axis.copy(axis);
    placeNeedle(tip, axis, this.group.matrix);
    this.group.matrixWorldNeedsUpdate = true;
  }

  /**
   * Whether a camera sees the hub. covered: share of the view's height under its toolbar. A hub with a syringe is not
   * drawn for a camera that looks along the needle: it would hide all that lies before it.
   */
  hubSeen(camera: Camera, covered: number): boolean {
    const along = Math.abs(camera.getWorldDirection(this.ahead).dot(this.axis));
    this.hub.group.visible = this.look !== "tuohy" || along < ALONG;
    return this.hub.group.visible && !outOfView(this.hubMiddle(), camera, covered);
  }

  /** The middle of the hub, mm. */
  private hubMiddle(): Vector3 {
    return this.middle
      .set(0, HUB_MM / 2, 0)
      .applyMatrix4(this.hub.group.matrix)
      .applyMatrix4(this.group.matrix);
  }

  /** The corners of a box around hub and syringe, with the plunger drawn out, mm: for a tip and an axis. */
  outline(tip: Vector3, axis: Vector3): Vector3[] {
    const syringe = syringeReach(this.size);
    const [end, wide] = this.look === "tuohy" ? [HUB_MM - 1 + syringe.length, syringe.radius] : [HUB_MM, HUB_RADIUS_MM];
    const matrix = placeNeedle(tip, axis);
    const middle = tipOffset(this.look) * this.diameter;
    return [0, end].flatMap((back) =>
      [[-1, -1], [-1, 1], [1, -1], [1, 1]].map(([x, y]) =>
        new Vector3(middle + x! * wide, y! * wide, this.length + back).applyMatrix4(matrix),
      ),
    ); // biome-ignore format: a table
  }

  get state(): NeedleState {
    const { look, diameter, content, plunger, size } = this;
    return { look, diameter, content, plunger, syringe: size, blood: this.blood.value, pressed: this.pressed.value };
  }

  /**
   * Shows blood at the bore's mouth and in the hub, and moves the plunger, as at the source's moment. A replay that
   * begins or jumps shows what came before it. Returns whether the picture changes: not by a jump alone, which is also
   * a late frame.
   */
  follow(source: Source, moment: Moment, scene: SceneView): boolean {
    const laws = source.laws.value;
    const before = this.shown();
    const steps = this.blood.jumps(moment.time) ? LASTS / STEP : 0;
    for (let k = steps; k > 0; k--) {
      const tick = moment.tick - Math.round(k * STEP * scene.rate);
      if (tick >= source.history.first && this.past.read(source, tick)) this.step(this.past, scene, laws);
    }
    this.step(moment, scene, laws);
    return this.shown() !== before;
  }

  private shown(): string {
    return [this.content, this.plunger, this.blood.value, this.pressed.value].join();
  }

  private step(moment: Moment, scene: SceneView, laws: readonly LawCurve[]): void {
    const { content, open } = atTip(moment, scene, laws);
    this.content = content;
    this.plunger = plungerOf(moment);
    const bleeds = content === "blood";
    this.mouth.color.copy(bleeds ? this.theme.color("blood") : EMPTY);
    const filled = this.blood.step(bleeds ? 1 : 0, moment.time, bleeds ? FILLS : DRAINS);
    // Without a syringe in the scene, the picture's own empties in the spaces where resistance is lost. What has left
    // it does not return: it is refilled when the needle is out of the tissue.
    const real = this.plunger !== null;
    const yields = !real && this.look === "tuohy" && YIELDING.has(content);
    const goal = real
      ? shareOf(moment.plunger, this.size.travel)
      : yields ? 1 : content === "outside" ? 0 : this.pressed.value; // biome-ignore format: a table
    const moved = this.pressed.step(goal, moment.time, yields ? YIELDS * open : 100, true);
    if (filled) this.hub.show(this.blood.value);
    if (moved) this.syringe.show(this.pressed.value);
  }

  /** A ring at every centimetre from the tip, as on a Tuohy needle. */
  private mark(middle: number, length: number): void {
    const count = this.look === "tuohy" ? Math.min(MOST_MARKS, Math.ceil(length / MARK_EVERY_MM) - 1) : 0;
    const wide = this.diameter * 1.02;
    for (let i = 0; i < count; i++) {
      const placed = new Matrix4().makeScale(wide, wide, 1).setPosition(middle, 0, (i + 1) * MARK_EVERY_MM);
      this.marks.setMatrixAt(i, placed);
    }
    this.marks.count = count;
    this.marks.instanceMatrix.needsUpdate = true;
    this.marks.frustumCulled = false;
  }
}
