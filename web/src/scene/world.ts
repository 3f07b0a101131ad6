import { type Camera, Vector3 } from "three";
import type { Triple } from "../engine/engine.ts";
import { newton } from "../format.ts";
import type { Pose } from "../hand/hand.ts";
import type { Goal } from "../state/app.ts";
import { feltForce, MODEL_FORCE } from "../state/scale.ts";
import type { Source } from "../state/source.ts";
import type { SceneView } from "../wire/messages.ts";
import { codeOf } from "../wire/ticks.ts";
import { type Extent, extentOf, surfaceOf } from "./anatomy.ts";
import { ForceArrow } from "./arrow.ts";
import { Block } from "./block.ts";
import { Blood } from "./blood.ts";
import { Fade } from "./fade.ts";
import { FatLine } from "./fat_line.ts";
import { DepthScale } from "./framing.ts";
import { Ghost } from "./ghost.ts";
import { GoalMark } from "./goal_mark.ts";
import { Holes } from "./holes.ts";
import type { Labels } from "./labels.ts";
import { Membranes } from "./membranes.ts";
import { MM, Moment, OUTSIDE } from "./moment.ts";
import { Needle, type NeedleState } from "./needle.ts";
import { needleLook } from "./needle_look.ts";
import { Shown } from "./shown.ts";
import { tangents } from "./slab_shape.ts";
import type { Stage } from "./stage.ts";
import type { Theme } from "./theme.ts";
import { Trail } from "./trail.ts";

const ACTIVE = codeOf("state", "active");
const BEFORE_MM = 3; // in front of the skin: so far out, the needle is always in the picture
const BELOW_MM = 3; // drawn depth below the last of the sheets
const WIDER = 1.8; // times the tissue's width, on the stage: a needle that stands upright leaves room for it
const MORE = 12; // times half the tissue's width, on the stage: to the border of the page
const LEAST_HEIGHT_PX = 40; // of the tissue, for a scale of depths beside it

/** Everything that the view draws for one moment of a source. */
export class World {
  readonly moment = new Moment();
  extent: Extent | null = null;
  private scene: SceneView | null = null;
  private shape = "";
  private readonly needle: Needle;
  private readonly membranes: Membranes;
  private readonly block: Block;
  private readonly blood: Blood;
  private readonly arrow: ForceArrow;
  private readonly trail: Trail;
  private readonly ghost: Ghost;
  private readonly entry = new FatLine(1.5, 0.85, 0.8);
  private readonly holes = new Holes();
  private readonly mark: GoalMark;
  private goal: Goal | null = null;
  private readonly drawn = new Shown();
  private readonly fade = new Fade();
  /** Whether the last change was one of the trail alone, which goes on fading. */
  still = false;
  /** On which sides the tissue goes on to the border of the page; if at all, names and force are not in the view. */
  wide: "no" | "left" | "both" = "no";

  constructor(
    private readonly stage: Stage,
    private readonly labels: Labels,
    theme: Theme,
  ) {
    this.needle = new Needle(theme);
    this.membranes = new Membranes(theme);
    this.block = new Block(theme);
    this.blood = new Blood(theme);
    this.arrow = new ForceArrow(theme);
    this.trail = new Trail(theme);
    this.ghost = new Ghost(theme);
    this.mark = new GoalMark(theme);
    theme.watch(() => this.entry.paint(theme.color("data-4")));
    stage.scene.add(
      this.needle.group, this.membranes.group, this.block.group, this.blood.slab.mesh, this.arrow.group,
      this.trail.line, this.ghost.group, this.entry.line, this.mark.group,
    ); // biome-ignore format: a list
  }

  /** Builds the scene. Returns whether its geometry changed. */
  build(scene: SceneView): boolean {
    const wider = this.wide !== "no" && scene.lumen.length === 0 ? WIDER : 1;
    const before = this.shape;
    this.scene = scene;
    this.shape = `${this.wide} ${shapeOf(scene)}`;
    if (before === this.shape) return false;
    this.moment.tick = -1;
    const extent = extentOf(scene);
    const { length } = extent;
    const size = wider * extent.size;
    this.extent = { ...extent, size };
    this.needle.build(scene, length);
    this.ghost.build(scene, length);
    const more = MORE * extent.size;
    const asBlock = this.block.build(scene, size, this.wide === "no" ? 0 : more, this.wide === "both" ? more : 0);
    this.membranes.build(asBlock ? { ...scene, membranes: [] } : scene, size);
    this.blood.build(scene.lumen, !asBlock);
    this.labels.clear();
    this.drawn.forget();
    this.aim(this.goal);
    return true;
  }

  /** Shows what an exercise asks to reach. */
  aim(goal: Goal | null): void {
    this.goal = goal;
    const deepest = this.block.shown ? this.block.bottom : Number.POSITIVE_INFINITY;
    this.mark.show(goal, this.scene, this.extent?.size ?? 1, deepest);
    this.stage.stale = true;
  }

  /**
   * Updates everything to the source's shown tick. Returns whether the picture changes. ghost: a second needle, of the
   * hand's target or of an expert. pixel: its size, mm.
   */
  update(source: Source, target: Pose | null, camera: Camera, pixel: number): boolean {
    const { moment, scene, extent } = this;
    this.block.showBars(this.wide === "no"); // the stage has no curves of single membranes
    if (!scene || !extent || source.history.membranes !== scene.membranes.length || !moment.read(source)) return false;
    this.holes.read(source, scene.membranes);
    let changed = this.membranes.update(moment, this.holes);
    changed = this.block.update(moment, this.holes, camera, pixel) || changed;
    if (this.block.shown) this.mark.follow(this.block.edgeMiddle, this.block.cut.along);
    changed = this.blood.update(this.membranes, moment.axis) || changed;
    changed = this.needle.follow(source, moment, scene) || changed;
    if (!this.differs(this.values(target, pixel), changed)) return false;
    this.needle.place(moment.tip, moment.axis);
    this.trail.update(source, moment.tick, scene.rate);
    this.placeArrow(camera, extent, scene);
    this.placeEntry(scene);
    const to = target && {
      position: new Vector3(...target.position).multiplyScalar(MM),
      axis: new Vector3(...target.axis).normalize(),
    };
    this.ghost.place(to, moment.tip);
    return true;
  }

  /** Places the arrow in the view plane, on the left of the needle: the bevel faces right. */
  placeArrow(camera: Camera, extent: Extent, scene: SceneView): void {
    const { moment } = this;
    const real = moment.state === ACTIVE;
    const left = new Vector3().setFromMatrixColumn(camera.matrixWorld, 0).negate();
    const from = moment.tip.clone().addScaledVector(left, 1.4 * scene.diameter * MM + 0.05 * extent.radius);
    const force = real ? moment.force : moment.modelForce;
    this.arrow.place(from, force, extent.mmPerNewton, 0.011 * extent.radius, real);
  }

  private placeEntry(scene: SceneView): void {
    const last = this.moment.membranes.findLastIndex(
      ({ phase, direction }) => phase !== OUTSIDE && direction.lengthSq() > 0.5,
    );
    const state = this.moment.membranes[last];
    const extent = this.extent;
    if (!state || !extent || this.block.shown) {
      this.entry.setEnds(null);
      return;
    }
    const ahead = Math.max(4, 0.4 * extent.deep);
    const side = scene.diameter * MM;
    this.entry.setEnds([
      state.proxy.clone().addScaledVector(state.direction, 0.4 * side),
      state.proxy.clone().addScaledVector(state.direction, ahead),
    ]);
    this.entryEnd.copy(state.proxy).addScaledVector(state.direction, ahead);
  }
  private readonly entryEnd = new Vector3();

  /** The middle of what the presets show, mm. */
  get middle(): Vector3 {
    const { cut } = this.block;
    const middle = this.extent?.centre.clone() ?? new Vector3();
    return this.block.shown ? middle.addScaledVector(cut.along, cut.middle) : middle;
  }

  /** Corners of the tissue and the needle as they are now and with the tip in front of the skin, mm. */
  outline(): Vector3[] {
    const { moment, extent, needle, scene } = this;
    if (!extent || !scene) return [];
    const { point, normal } = surfaceOf(scene);
    const inwards = Math.max(0.2, moment.axis.dot(normal));
    const depth = moment.tip.clone().sub(point).dot(normal);
    const before = moment.tip.clone().addScaledVector(moment.axis, -Math.max(0, depth + BEFORE_MM) / inwards);
    return [
      ...(this.block.shown ? this.block.corners() : sheetCorners(point, normal, extent)),
      moment.tip,
      ...[moment.tip, before].flatMap((tip) => needle.outline(tip, moment.axis)),
    ];
  }

  /** The needle, hub and syringe on the screen: left, top, right and bottom as shares of the view. */
  needleBox(camera: Camera): number[] {
    const { tip, axis } = this.moment;
    const on = [tip, ...this.needle.outline(tip, axis)].map((point) => point.clone().project(camera));
    const x = on.map((point) => (1 + point.x) / 2);
    const y = on.map((point) => (1 - point.y) / 2);
    return [Math.min(...x), Math.min(...y), Math.max(...x), Math.max(...y)];
  }

  /** Where a point (m) is in the view, px. */
  onScreen(point: Triple, camera: Camera): [x: number, y: number] {
    const { x, y } = new Vector3(...point).multiplyScalar(MM).project(camera);
    return [((1 + x) / 2) * this.stage.width, ((1 - y) / 2) * this.stage.height];
  }

  /** Where depths are on the screen, beside the tissue; null if the camera does not see one below the other. */
  depths(camera: Camera): DepthScale | null {
    const { extent, scene, stage } = this;
    if (!extent || !scene) return null;
    const deep = this.block.shown ? this.block.bottom : extent.deep + BELOW_MM;
    const { point, normal } = surfaceOf(scene);
    const right = new Vector3().setFromMatrixColumn(camera.matrixWorld, 0);
    const [zero, half, whole] = [0, deep / 2, deep].map((depth) => {
      const at = this.block.shown
        ? this.block.edge(depth, camera)
        : point.clone().addScaledVector(normal, depth).addScaledVector(right, extent.size);
      return ((1 - at.project(camera).y) / 2) * stage.height;
    }) as [number, number, number];
    return whole - zero > LEAST_HEIGHT_PX ? new DepthScale(zero, half, whole, deep) : null;
  }

  /** What the hub and the syringe show, if they show anything and are out of view. */
  hiddenHub(camera: Camera, covered: number): NeedleState | null {
    const { state } = this.needle;
    const shows = this.scene?.lumen.length || state.look === "tuohy";
    return !this.needle.hubSeen(camera, covered) && shows ? state : null;
  }

  name(camera: Camera): void {
    const { labels, stage } = this;
    const size = [stage.width, stage.height] as const;
    labels.begin();
    if (this.wide === "no") this.nameTissue(camera, size);
    if (this.mark.group.visible)
      labels.put("goal", `Goal: ${this.goal?.name}`, "goal", this.mark.middle, camera, size, "left");
    labels.end();
  }

  private nameTissue(camera: Camera, size: readonly [number, number]): void {
    const { labels, moment } = this;
    this.scene?.membranes.forEach((membrane, i) => {
      const at = this.block.shown ? this.block.labelPlace(i, camera) : this.rightmost(i, camera);
      labels.put(`membrane${i}`, membrane.name, "membrane", at, camera, size, "column");
    });
    if (this.arrow.group.visible) {
      const given = moment.state === ACTIVE;
      const much = newton(this.arrow.shown);
      const words = given ? `${feltForce(moment.scale)} ${much}` : `${MODEL_FORCE} ${much} (not output)`;
      labels.put("force", words, "force", this.arrow.head, camera, size, "left");
    }
    if (this.entry.line.visible) labels.put("entry", "direction at entry", "entry", this.entryEnd, camera, size);
  }

  /** The edge of a slab that is farthest to the right on the screen. */
  private rightmost(index: number, camera: Camera): Vector3 {
    const placed = this.membranes.placed[index]!;
    const { normal } = placed;
    const middle = this.membranes.middle(placed).addScaledVector(normal, placed.thickness / 2);
    const right = new Vector3().setFromMatrixColumn(camera.matrixWorld, 0);
    const along = right.addScaledVector(normal, -right.dot(normal));
    if (along.lengthSq() < 1e-4) return middle;
    return middle.addScaledVector(along.normalize(), this.membranes.size);
  }

  /** Whether the picture changed. */
  private differs(values: readonly number[], changed: boolean): boolean {
    const differs = this.drawn.differs(values) || changed;
    const faded = this.fade.step(this.moment.time, differs);
    this.still = !differs;
    return differs || faded;
  }

  /** The picture's values in steps that can be seen: smaller motions of the hand need no new picture. */
  private values(target: Pose | null, pixel: number): number[] {
    const { tip, axis, force, modelForce, state } = this.moment;
    const step = Math.max(1e-3, pixel);
    const places = [tip, ...(target ? [new Vector3(...target.position).multiplyScalar(MM)] : [])];
    const others = [axis, force, modelForce, ...(target ? [new Vector3(...target.axis)] : [])];
    return [
      state,
      ...places.flatMap(({ x, y, z }) => [x / step, y / step, z / step]),
      ...others.flatMap(({ x, y, z }) => [250 * x, 250 * y, 250 * z]),
    ];
  }
}

/** The corners of sheets of glass, mm. */
function sheetCorners(point: Vector3, normal: Vector3, { size, deep }: Extent): Vector3[] {
  const [right, forward] = [new Vector3(), new Vector3()];
  tangents(normal, right, forward);
  const signs = [-1, 1];
  return [0, deep + BELOW_MM].flatMap((depth) =>
    signs.flatMap((x) =>
      signs.map((z) =>
        point
          .clone()
          .addScaledVector(normal, depth)
          .addScaledVector(right, x * size)
          .addScaledVector(forward, z * size),
      ),
    ),
  );
}

/** The parts of a scene that need a rebuild of the view if they change. Friction, for example, does not. */
function shapeOf(scene: SceneView): string {
  const { diameter, tip_length, membranes, lumen, syringe } = scene;
  return JSON.stringify([
    needleLook(scene),
    diameter,
    tip_length,
    lumen,
    syringe,
    membranes.map((m) => [m.name, m.point, m.inward_normal, m.thickness, m.look, m.behind]),
  ]);
}
