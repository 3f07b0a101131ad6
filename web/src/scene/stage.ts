import type { Camera } from "three";
import { DirectionalLight, HemisphereLight, Scene, WebGLRenderer } from "three";
import { Quality } from "./quality.ts";
import type { Theme } from "./theme.ts";

const HIGHEST_RATIO = 2; // device pixels per CSS pixel, along each side

/** The canvas, its lights and its size. It recovers after a loss of the WebGL context. */
export class Stage {
  readonly scene = new Scene();
  width = 1;
  height = 1;
  private readonly key = new DirectionalLight(0xffffff, 1.6);
  private readonly sky = new HemisphereLight(0xffffff, 0x8a8f98, 0.8);
  /** Sharpness while the picture moves. */
  private readonly quality: Quality;
  /** Pixel ratio of a still picture. */
  private readonly resting: number;
  private ratio: number;
  /** Whether the whole picture must be drawn again. */
  stale = true;
  lost = false;

  /** Throws if the browser has no WebGL. */
  constructor(
    readonly canvas: HTMLCanvasElement,
    host: HTMLElement,
    theme: Theme,
    private readonly resized: () => void,
    lost: (gone: boolean) => void,
    private readonly coarser: (words: string) => void,
  ) {
    const software = drawsInSoftware();
    this.quality = new Quality(Math.min(software ? 1 : HIGHEST_RATIO, window.devicePixelRatio || 1));
    this.ratio = this.quality.ratio;
    // Antialiasing costs a graphics card almost nothing, but is four times the work in software.
    this.renderer = new WebGLRenderer({
      canvas,
      antialias: !software,
      alpha: true,
      powerPreference: "high-performance",
    });
    // In software, a still picture has four pixels for one of the screen, whose mean smooths its edges.
    this.resting = software ? 2 * Math.min(1, devicePixelRatio || 1) : this.quality.best;
    this.renderer.setClearAlpha(0);
    this.key.position.set(0.6, 1, 0.9);
    this.scene.add(this.key, this.sky);
    theme.watch(() => {
      this.key.intensity = theme.dark ? 1.5 : 1.3;
      this.sky.intensity = theme.dark ? 1.3 : 1.9;
      this.stale = true;
    });
    canvas.addEventListener("webglcontextlost", (event) => {
      event.preventDefault(); // otherwise the browser does not restore the context
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
    this.renderer.setPixelRatio(this.ratio);
    this.renderer.setSize(this.width, this.height, false);
    this.resized();
    this.stale = true;
  }

  /** now: ms. painted: whether the browser paints next. moves: or only fades, which is drawn at full sharpness. */
  draw(camera: Camera, now: number, painted: boolean, moves: boolean): void {
    const rests = this.quality.rests(now, moves);
    if (this.quality.step(now, !rests, painted)) this.coarser(this.quality.words());
    this.setRatio(rests ? this.resting : this.quality.ratio);
    this.renderer.render(this.scene, camera);
    this.stale = false;
  }

  /** Called in frames without a change: after a while the picture is drawn once more, at full sharpness. */
  rest(camera: Camera, now: number, painted: boolean): void {
    if (this.quality.step(now, false, painted)) this.coarser(this.quality.words());
    if (this.ratio >= this.resting || !this.quality.rests(now, false)) return;
    this.setRatio(this.resting);
    this.renderer.render(this.scene, camera);
  }

  private setRatio(ratio: number): void {
    if (ratio === this.ratio) return;
    this.ratio = ratio;
    this.renderer.setPixelRatio(ratio);
  }
}

const SOFTWARE = /swiftshader|llvmpipe|softpipe|software|basic render/i;

/** Whether the browser renders WebGL in software, without a graphics card. */
function drawsInSoftware(): boolean {
  const context = document.createElement("canvas").getContext("webgl2");
  if (!context) return false;
  const names = context.getExtension("WEBGL_debug_renderer_info");
  const name = String(context.getParameter(names ? names.UNMASKED_RENDERER_WEBGL : context.RENDERER));
  context.getExtension("WEBGL_lose_context")?.loseContext();
  return SOFTWARE.test(name);
}
