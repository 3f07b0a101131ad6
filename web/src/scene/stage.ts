import type { Camera } from "three";
import {
  AmbientLight, DirectionalLight, HemisphereLight, NeutralToneMapping, PMREMGenerator, Scene, WebGLRenderer,
} from "three"; // biome-ignore format: a list
import { RoomEnvironment } from "three/examples/jsm/environments/RoomEnvironment.js";
import type { Theme } from "./theme.ts";

const SHARPEST = 2;
const SLOW_MS = 40;

/** The canvas, its lights and its size; survives the loss of the graphics card. */
export class Stage {
  readonly scene = new Scene();
  width = 1;
  height = 1;
  private readonly key = new DirectionalLight(0xffffff, 1.6);
  private readonly sky = new HemisphereLight(0xffffff, 0x8a8f98, 0.8);
  private readonly fill = new AmbientLight(0xffffff, 0.15);
  private sharpness = Math.min(SHARPEST, window.devicePixelRatio || 1);
  private slow = 0;
  /** Whether all must be drawn anew. */
  stale = true;
  lost = false;

  /** Throws where the browser has no WebGL. */
  constructor(
    readonly canvas: HTMLCanvasElement,
    host: HTMLElement,
    theme: Theme,
    private readonly resized: () => void,
    lost: (gone: boolean) => void,
  ) {
    this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true, powerPreference: "high-performance" });
    this.renderer.toneMapping = NeutralToneMapping;
    this.renderer.setClearAlpha(0);
    this.furnish();
    this.key.position.set(0.6, 1, 0.9);
    this.scene.add(this.key, this.sky, this.fill);
    theme.watch(() => {
      this.scene.environmentIntensity = theme.dark ? 0.45 : 0.6;
      this.key.intensity = theme.dark ? 1.3 : 1.5;
      this.sky.intensity = theme.dark ? 0.55 : 0.9;
      this.stale = true;
    });
    canvas.addEventListener("webglcontextlost", (event) => {
      event.preventDefault(); // or the browser would never give it back
      this.lost = true;
      lost(true);
    });
    canvas.addEventListener("webglcontextrestored", () => {
      this.lost = false;
      this.furnish();
      this.stale = true;
      lost(false);
    });
    new ResizeObserver(() => this.resize(host)).observe(host);
    this.resize(host);
  }
  private readonly renderer: WebGLRenderer;

  private furnish(): void {
    const maker = new PMREMGenerator(this.renderer);
    this.scene.environment = maker.fromScene(new RoomEnvironment(), 0.04).texture;
    maker.dispose();
  }

  private resize(host: HTMLElement): void {
    this.width = Math.max(1, host.clientWidth);
    this.height = Math.max(1, host.clientHeight);
    this.renderer.setPixelRatio(this.sharpness);
    this.renderer.setSize(this.width, this.height, false);
    this.resized();
    this.stale = true;
  }

  draw(camera: Camera): void {
    const began = performance.now();
    this.renderer.render(this.scene, camera);
    this.stale = false;
    this.watchSpeed(performance.now() - began);
  }

  /** Without a graphics card fewer pixels are better than fewer pictures. */
  private watchSpeed(took: number): void {
    this.slow = took > SLOW_MS ? this.slow + 1 : 0;
    if (this.slow < 20 || this.sharpness <= 0.75) return;
    this.slow = 0;
    this.sharpness = Math.max(0.75, this.sharpness * 0.75);
    this.renderer.setPixelRatio(this.sharpness);
    this.stale = true;
  }
}
