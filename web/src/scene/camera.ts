import { MathUtils, PerspectiveCamera, Plane, Ray, Vector2, Vector3 } from "three";
import { type Free, isBeside } from "./framing.ts";

/** front: the cut is parallel to the screen, so that depths are heights. */
export type Preset = "oblique" | "side" | "top" | "needle" | "front";

const SETTLE_MS = 90;
const CLOSEST_MM = 4;
const FARTHEST_MM = 900;
/** Below this sine of the angle between view and plane, the camera sees the plane from its edge. */
const EDGE = 0.15;
const STEEPEST = MathUtils.degToRad(89.5);

interface Pose {
  azimuth: number;
  elevation: number;
  distance: number;
  readonly target: Vector3;
}

/** A camera that orbits a point. Presets and zoom move it smoothly; a drag moves it at once. */
export class OrbitCamera {
  /** A long focal length: parallel lines look parallel, and the scale bar is also nearly right away from the tip. */
  readonly camera = new PerspectiveCamera(20, 1, 1, 4000);
  private readonly now: Pose = { azimuth: 0.4, elevation: 0.25, distance: 100, target: new Vector3() };
  private readonly goal: Pose = { azimuth: 0.4, elevation: 0.25, distance: 100, target: new Vector3() };
  private home = { centre: new Vector3(), radius: 20 };
  private moved = true;
  private fitted = false;
  private resized = false; // since the last `enclose`
  private readonly reducedMotion = matchMedia("(prefers-reduced-motion: reduce)");

  /** Keeps the whole scene in view after a preset. A zoom chosen by the user stays. */
  resize(width: number, height: number): void {
    this.camera.aspect = width / Math.max(1, height);
    this.camera.updateProjectionMatrix();
    this.moved = this.resized = true;
    if (!this.fitted) return;
    this.goal.distance = this.fittingDistance();
    this.now.distance = this.goal.distance;
  }

  private fittingDistance(): number {
    const half = MathUtils.degToRad(this.camera.fov / 2);
    return this.home.radius / Math.sin(Math.atan(Math.tan(half) * Math.min(1, this.camera.aspect)));
  }

  /** Sets the sphere that the presets show, mm. */
  frame(centre: Vector3, radius: number): void {
    this.home = { centre: centre.clone(), radius };
  }

  preset(preset: Preset, axis: Vector3, tip: Vector3): void {
    const { goal, home } = this;
    goal.target.copy(home.centre);
    goal.distance = this.fittingDistance();
    this.fitted = true;
    goal.azimuth = 0;
    goal.elevation = 0;
    if (preset === "oblique") {
      goal.azimuth = MathUtils.degToRad(24);
      goal.elevation = MathUtils.degToRad(20);
    } else if (preset === "front") {
      goal.elevation = MathUtils.degToRad(11);
    } else if (preset === "top") {
      goal.elevation = STEEPEST;
    } else if (preset === "needle") {
      // From behind the hub and a little above it; otherwise the needle would hide its target.
      goal.azimuth = Math.abs(axis.y) > 0.98 ? 0 : Math.atan2(-axis.x, -axis.z);
      goal.elevation = MathUtils.clamp(Math.asin(-axis.y) + (axis.y < -0.8 ? -0.22 : 0.16), -STEEPEST, STEEPEST);
      goal.target.copy(tip);
    }
    // Turns the shorter way.
    this.now.azimuth =
      goal.azimuth + MathUtils.euclideanModulo(this.now.azimuth - goal.azimuth + Math.PI, 2 * Math.PI) - Math.PI;
  }

  /**
   * Moves so that all points (mm) are as large as possible in the free part of the view, and beside what stands to the
   * right of it. A zoom chosen by the user stays.
   */
  enclose(points: readonly Vector3[], free: Free): void {
    if (!this.fitted || points.length === 0) return;
    const { goal, camera } = this;
    const high = Math.tan(MathUtils.degToRad(camera.fov / 2));
    const wide = high * camera.aspect;
    const back = direction(goal);
    const right = new Vector3(Math.cos(goal.azimuth), 0, -Math.sin(goal.azimuth));
    const up = new Vector3().crossVectors(back, right);
    // In each of two directions the camera sees p between two lines: low * (c.z - p.z) <= p.x - c.x <= high * (...).
    const between = (axis: Vector3, low: number, high: number) => {
      const most = Math.max(...points.map((p) => p.dot(axis) + high * p.dot(back)));
      const least = Math.min(...points.map((p) => p.dot(axis) + low * p.dot(back)));
      return {
        away: (most - least) / (high - low),
        last: (away: number): number => most - high * away,
        middle: (away: number): number => (most - high * away + least - low * away) / 2,
      };
    };
    const x = between(right, (2 * free.left - 1) * wide, (2 * free.right - 1) * wide);
    const y = between(up, (1 - 2 * free.bottom) * high, (1 - 2 * free.top) * high);
    const away = Math.max(x.away, y.away);
    goal.distance = away - this.home.centre.dot(back);
    goal.target
      .copy(back)
      .multiplyScalar(away - goal.distance)
      .addScaledVector(right, isBeside(free) ? x.last(away) : x.middle(away))
      .addScaledVector(up, y.middle(away));
    if (this.resized) this.settle();
    this.resized = false;
  }

  orbit(dx: number, dy: number): void {
    this.goal.azimuth = this.now.azimuth -= dx * 0.007;
    this.goal.elevation = this.now.elevation = MathUtils.clamp(this.now.elevation + dy * 0.007, -STEEPEST, STEEPEST);
    this.moved = true;
  }

  /** Moves by pixels of a view that is `height` pixels high. */
  pan(dx: number, dy: number, height: number): void {
    const scale = this.mmPerPixel(this.now.target, height);
    const right = new Vector3().setFromMatrixColumn(this.camera.matrixWorld, 0);
    const up = new Vector3().setFromMatrixColumn(this.camera.matrixWorld, 1);
    this.now.target.addScaledVector(right, -dx * scale).addScaledVector(up, dy * scale);
    this.goal.target.copy(this.now.target);
    this.moved = true;
  }

  /** A factor > 1 moves the camera nearer. */
  zoom(factor: number): void {
    this.fitted = false;
    this.goal.distance = MathUtils.clamp(this.goal.distance / factor, CLOSEST_MM, FARTHEST_MM);
  }

  /** Moves on towards the goal. Returns whether the picture changes. */
  step(elapsedMs: number): boolean {
    const { now, goal } = this;
    const left =
      Math.abs(goal.azimuth - now.azimuth) +
      Math.abs(goal.elevation - now.elevation) +
      Math.abs(goal.distance / now.distance - 1) +
      goal.target.distanceTo(now.target) / now.distance;
    if (left > 1e-5) {
      const part = left < 1e-3 || this.reducedMotion.matches ? 1 : 1 - Math.exp(-elapsedMs / SETTLE_MS);
      now.azimuth += part * (goal.azimuth - now.azimuth);
      now.elevation += part * (goal.elevation - now.elevation);
      now.distance *= (goal.distance / now.distance) ** part;
      now.target.lerp(goal.target, part);
      this.moved = true;
    }
    if (!this.moved) return false;
    this.moved = false;
    this.camera.position.copy(direction(now)).multiplyScalar(now.distance).add(now.target);
    this.camera.near = now.distance * 0.05;
    this.camera.far = now.distance + 800;
    this.camera.updateProjectionMatrix();
    this.camera.lookAt(now.target);
    this.camera.updateMatrixWorld();
    return true;
  }

  /** Jumps to the goal without a smooth motion. */
  settle(): void {
    Object.assign(this.now, {
      azimuth: this.goal.azimuth,
      elevation: this.goal.elevation,
      distance: this.goal.distance,
    });
    this.now.target.copy(this.goal.target);
    this.moved = true;
  }

  /** Size of a pixel at `point`, mm, in a view that is `height` pixels high. */
  mmPerPixel(point: Vector3, height: number): number {
    const forward = new Vector3().setFromMatrixColumn(this.camera.matrixWorld, 2);
    const away = new Vector3().subVectors(this.camera.position, point).dot(forward);
    return (2 * away * Math.tan(MathUtils.degToRad(this.camera.fov / 2))) / Math.max(1, height);
  }

  /**
   * Projects a pixel to the plane through `point` with this normal. Where the camera sees that plane from its edge, a
   * drag along the edge moves in the plane, and one across it does nothing.
   */
  onPlane(point: Vector3, normal: Vector3, x: number, y: number, width: number, height: number): Vector3 | null {
    const at = new Vector2((2 * x) / width - 1, 1 - (2 * y) / height);
    const ray = new Ray(this.camera.position.clone());
    ray.direction.set(at.x, at.y, 0.5).unproject(this.camera).sub(ray.origin).normalize();
    const facing = new Vector3().setFromMatrixColumn(this.camera.matrixWorld, 2);
    const seen = Math.abs(facing.dot(normal)) > EDGE ? normal : facing;
    const found = ray.intersectPlane(new Plane().setFromNormalAndCoplanarPoint(seen, point), new Vector3());
    return found?.addScaledVector(normal, -found.clone().sub(point).dot(normal)) ?? null;
  }
}

/** From the target to the camera. */
function direction({ azimuth, elevation }: Pose): Vector3 {
  const flat = Math.cos(elevation);
  return new Vector3(flat * Math.sin(azimuth), Math.sin(elevation), flat * Math.cos(azimuth));
}
