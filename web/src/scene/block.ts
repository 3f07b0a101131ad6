import { type Camera, Group, MathUtils, Vector3 } from "three";
import { Field } from "../tissue/field.ts";
import type { Window } from "../tissue/grid.ts";
import { type Layer, layersOf, type Vessel, vesselOf } from "../tissue/layers.ts";
import { cutSheet, endSheet, surfaceSheet } from "../tissue/sheet.ts";
import type { SceneView } from "../wire/messages.ts";
import { Cut, DEEP } from "./cut.ts";
import { CutFace } from "./cut_face.ts";
import { Ends } from "./ends.ts";
import { gripsOf } from "./grips.ts";
import type { Holes } from "./holes.ts";
import { MM, type Moment } from "./moment.ts";
import { needleLook, tipOffset } from "./needle_look.ts";
import { Paper } from "./paper.ts";
import { Shown } from "./shown.ts";
import { Surface } from "./surface.ts";
import type { Theme } from "./theme.ts";
import { Tracks } from "./tracks.ts";

const PIXELS_ACROSS = 1024; // of the painted cut
const PAINT_MS = 7; // per frame, until all sheets are painted

interface Parts {
  readonly layers: readonly Layer[];
  readonly vessel: Vessel | null;
  readonly field: Field;
  readonly face: CutFace;
  readonly surface: Surface;
  readonly ends: Ends;
  readonly tracks: Tracks;
  readonly papers: readonly Paper[];
  readonly front: Paper;
}

/** Tissue as a block that is cut open at the needle, for scenes whose membranes have a look. */
export class Block {
  readonly group = new Group();
  readonly cut = new Cut();
  private parts: Parts | null = null;
  private size = 10;
  private left = 0;
  private right = 0;
  private diameter = 1;
  private aside = 0.5;
  private readonly drawn = new Shown();

  constructor(private readonly theme: Theme) {
    this.group.matrixAutoUpdate = false;
    theme.watch(() => this.paint());
  }

  get shown(): boolean {
    return this.parts !== null;
  }

  /** size: half its width; left, right: more of it, mm. Returns whether the scene is drawn as a block. */
  build(scene: SceneView, size: number, left = 0, right = 0): boolean {
    this.clear();
    const layers = layersOf(scene);
    if (!layers) return false;
    this.size = size;
    this.left = left;
    this.right = right;
    this.diameter = scene.diameter * MM;
    this.aside = tipOffset(needleLook(scene)) * this.diameter;
    const vessel = vesselOf(scene, layers);
    const top = scene.membranes[layers[0]!.membrane!]!;
    const deep = DEEP * size;
    const perMm = PIXELS_ACROSS / (2 * size);
    this.cut.build(new Vector3(...top.point).multiplyScalar(MM), new Vector3(...top.inward_normal));
    const cut = new Paper(cutSheet(layers, vessel, 2 * size, perMm));
    const surface = new Paper(surfaceSheet(layers, 2 * size, perMm / 2));
    const front = surface.twin();
    const end = new Paper(endSheet(layers, vessel, deep, perMm), true);
    this.parts = {
      layers,
      vessel,
      field: new Field(layers, this.diameter),
      face: new CutFace(layers, vessel, cut, this.diameter),
      surface: new Surface(surface, front, deep),
      ends: new Ends(layers, [-size - left, size + right], deep, end),
      tracks: new Tracks(),
      papers: [cut, surface, end],
      front,
    };
    const { face, ends, tracks } = this.parts;
    const { grid, front: half } = this.parts.surface;
    this.group.add(face.grid.mesh, face.borders, grid.mesh, half, ends.group, tracks.mesh);
    this.paint();
    return true;
  }

  private clear(): void {
    if (!this.parts) return;
    const { face, surface, ends, tracks, papers, front } = this.parts;
    for (const part of [face, surface, ends, tracks, ...papers, front]) part.dispose();
    this.group.clear();
    this.parts = null;
    this.drawn.forget();
  }

  private paint(): void {
    const { theme, parts } = this;
    if (!parts) return;
    const light = theme.dark ? 0.88 : 1;
    for (const paper of [...parts.papers, parts.front]) paper.tint.setRGB(light, light, light);
    parts.ends.paint(theme);
    const { material } = parts.face.borders;
    if (!Array.isArray(material) && "color" in material)
      material.color = theme.color("page").clone().multiplyScalar(0.2);
    this.drawn.forget();
  }

  /** Shows or hides the colours that the membranes have in the plots. */
  showBars(shown: boolean): void {
    if (this.parts) this.parts.ends.bars.visible = shown;
  }

  /** Bends the tissue for the moment. Returns whether the picture changes. pixel: its size, mm. */
  update(moment: Moment, holes: Holes, camera: Camera, pixel: number): boolean {
    const { parts, cut, size } = this;
    if (!parts) return false;
    const painted = parts.papers.some((paper) => !paper.complete && paper.paint(PAINT_MS));
    cut.place(moment.tip, moment.axis, camera.position, size);
    const fading = this.openFront(camera, parts);
    const old = moment.membranes.map((_, i) => holes.of(i, moment.tick));
    const grips = gripsOf(moment, cut);
    const tip = cut.spot(moment.tip);
    const step = Math.max(1e-3, pixel);
    const places = [tip.u, tip.d, cut.w, cut.centre, ...grips.flatMap(({ proxy }) => [proxy.u, proxy.d])];
    const others = [...cut.towards.toArray(), ...moment.axis.toArray(), fading, ...grips.map(({ slope }) => slope)];
    const counts = [...grips.map(({ membrane }) => membrane), ...old.map(({ length }) => length)];
    const values = [...places.map((mm) => mm / step), ...others.map((value) => value * 250), ...counts];
    if (!this.drawn.differs(values)) return painted;
    const lean = moment.axis.dot(cut.down);
    const window: Window = { centre: cut.centre, size, left: this.left, right: this.right };
    parts.field.set(tip, grips, lean);
    const slope = moment.axis.dot(cut.along) / Math.max(0.2, Math.abs(lean));
    const side = this.aside; // from the tip to the middle of the shaft
    parts.face.needle = (d) => tip.u + slope * (d - tip.d) + side;
    parts.face.update(parts.field, window, cut.w, tip.d, lean);
    parts.surface.update(parts.field, window, cut.w);
    parts.tracks.update(parts.field, cut, old, parts.layers, this.diameter, window);
    parts.ends.group.position.set(cut.centre, 0, cut.w);
    this.group.matrix.copy(cut.matrix);
    this.group.matrixWorldNeedsUpdate = true;
    return true;
  }

  /** Closes the surface in front of the cut for a camera that looks from above. Returns its opacity. */
  private openFront(camera: Camera, { surface, front }: Parts): number {
    const away = camera.position.clone().sub(this.cut.origin).normalize();
    const opacity = MathUtils.smoothstep(-away.dot(this.cut.down), 0.72, 0.9);
    surface.front.visible = opacity > 0.01;
    front.fade(opacity);
    return opacity;
  }

  /** The corners without `left` and `right`, mm, before the needle moves them; empty if the scene has no block. */
  corners(): Vector3[] {
    const { cut, size, parts } = this;
    if (!parts) return [];
    return [0, this.bottom].flatMap((d) =>
      [-size, size].flatMap((u) => [0, -DEEP * size].map((w) => cut.point(cut.middle + u, d, w))),
    );
  }

  /** The middle of the upper edge of the cut, where it is drawn now, mm. */
  get edgeMiddle(): Vector3 {
    return this.cut.point(this.cut.centre, 0, this.cut.w);
  }

  /** Depth of its lower face, mm. */
  get bottom(): number {
    return this.parts?.layers.at(-1)?.bottom ?? 0;
  }

  /** The place of a layer's label. */
  labelPlace(membrane: number, camera: Camera): Vector3 {
    const layer = this.parts?.layers.find((each) => each.membrane === membrane);
    return this.edge(layer ? (layer.top + layer.bottom) / 2 : 0, camera);
  }

  /** The point of the block at a depth that is farthest to the right on the screen. */
  edge(depth: number, camera: Camera): Vector3 {
    const right = new Vector3().setFromMatrixColumn(camera.matrixWorld, 0);
    const side = right.dot(this.cut.along) >= 0 ? 1 : -1;
    const back = right.dot(this.cut.towards) >= 0 ? 0 : DEEP * this.size;
    const more = side < 0 ? this.left : this.right;
    return this.cut.point(this.cut.centre + side * (this.size + more), depth, this.cut.w - back);
  }
}
