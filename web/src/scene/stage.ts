import type { Camera } from "three";
import { DirectionalLight, HemisphereLight, Scene, WebGLRenderer } from "three";
import { drawsInSoftware } from "./software.ts";
import type { Theme } from "./theme.ts";

const SHARPEST = 2; // pixels of the picture a pixel of the page, along each side
const LEAST_SHARP = 0.75;
const SLOW_MS = 45;
const REST_MS = 250;

/** The canvas, its lights and its size; survives the loss of the graphics card. */
export class Stage {
  readonly scene = new Scene();
  width = 1;
  height = 1;
  private readonly key = new DirectionalLight(0xffffff, 1.6);
  private readonly sky = new HemisphereLight(0xffffff, 0x8a8f98, 0.8);
  /** While things move: less where that is too slow. At rest a picture is worth the time. */
  private moving = Math.min(SHARPEST, window.devicePixelRatio || 1);
  private readonly resting: number;
  private sharpness = this.moving;
  private slow = 0;
  private drawn = 0;
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
    const software = drawsInSoftware();
    // Smooth edges by four samples a pixel cost a graphics card nothing, and a processor four times the work.
    this.renderer = new WebGLRenderer({
      canvas,
      antialias: !software,
      alpha: true,
      powerPreference: "high-performance",
    });
    this.resting = software ? Math.max(1.75, this.moving) : this.moving;
    this.renderer.setClearAlpha(0);
    this.key.position.set(0.6, 1, 0.9);
    this.scene.add(this.key, this.sky);
    theme.watch(() => {
      this.key.intensity = theme.dark ? 1.5 : 1.3;
      this.sky.intensity = theme.dark ? 1.3 : 1.9;
      this.stale = true;
    });
    canvas.addEventListener("webglcontextlost", (event) => {
      event.preventDefault(); // or the browser would never give it back
      this.lost = true;
      lost(true);
    });
    canvas.addEventListener("webglcontextrestored", () => {
      this.lost = false;
      this.stale = true;
      lost(false);
    });
    new ResizeObserver(() => this.resize(host)).observe(host);
    this.resize(host);
  }
  private readonly renderer: WebGLRenderer;

  private resize(host: HTMLElement): void {
    this.width = Math.max(1, host.clientWidth);
    this.height = Math.max(1, host.clientHeight);
    this.renderer.setPixelRatio(this.sharpness);
    this.renderer.setSize(this.width, this.height, false);
    this.resized();
    this.stale = true;
  }

  draw(camera: Camera, now: number): void {
    const took = now - this.drawn;
    this.drawn = now;
    this.watchSpeed(took);
    this.sharpen(this.moving);
    this.renderer.render(this.scene, camera);
    this.stale = false;
  }

  /** To be called in frames in which nothing changes: after a while the picture is drawn once more, sharp. */
  rest(camera: Camera, now: number): void {
    if (this.sharpness >= this.resting || now - this.drawn < REST_MS) return;
    this.sharpen(this.resting);
    this.renderer.render(this.scene, camera);
  }

  private sharpen(sharpness: number): void {
    if (sharpness === this.sharpness) return;
    this.sharpness = sharpness;
    this.renderer.setPixelRatio(sharpness);
  }

  /** Without a graphics card fewer pixels are better than fewer pictures. took: ms since the last one. */
  private watchSpeed(took: number): void {
    if (took > 500) return; // nothing had changed in between
    this.slow = took > SLOW_MS ? this.slow + 1 : Math.max(0, this.slow - 2);
    if (this.slow < 20 || this.moving <= LEAST_SHARP) return;
    this.slow = 0;
    this.moving = Math.max(LEAST_SHARP, this.moving * 0.75);
  }
}
