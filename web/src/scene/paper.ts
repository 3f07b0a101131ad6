import {
  Color,
  DataTexture,
  DoubleSide,
  LinearFilter,
  LinearMipmapNearestFilter,
  RepeatWrapping,
  RGBAFormat,
  ShaderMaterial,
} from "three";
import type { Sheet } from "../tissue/sheet.ts";

const COARSE = 8; // pixels; the first picture appears at once and is then refined
const ROWS_AT_ONCE = 8;

/**
 * A material with a painted sheet and a brightness for each vertex. It needs no lights: a processor without a graphics
 * card draws it fast. The sheet is painted bit by bit, so that no frame is late for it.
 */
export class Paper {
  readonly tint = new Color(1, 1, 1);
  readonly material: ShaderMaterial;
  private readonly texture: DataTexture;
  private row = 0;

  constructor(
    private readonly sheet: Sheet,
    holes = false,
    texture?: DataTexture,
  ) {
    this.texture = texture ?? this.coarse();
    this.material = new ShaderMaterial({
      side: DoubleSide,
      uniforms: { map: { value: this.texture }, tint: { value: this.tint }, opacity: { value: 1 } },
      vertexShader: `attribute float shade; varying vec2 at; varying float bright;
        void main() {
          at = uv; bright = shade;
          gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
        }`,
      fragmentShader: `uniform sampler2D map; uniform vec3 tint; uniform float opacity;
        varying vec2 at; varying float bright;
        void main() { vec4 c = texture2D(map, at); ${holes ? "if (c.a < 0.5) discard;" : ""}
          gl_FragColor = vec4(c.rgb * (bright * tint), opacity); }`,
      polygonOffset: true,
      polygonOffsetFactor: 1,
      polygonOffsetUnits: 1,
    });
  }

  private coarse(): DataTexture {
    const { sheet } = this;
    sheet.paint(0, sheet.height, COARSE);
    const { data, width, height } = thinned(sheet, COARSE); // drawn larger it is soft, and has no squares
    const texture = new DataTexture(data, width, height, RGBAFormat);
    texture.wrapS = RepeatWrapping;
    if (sheet.tiles) texture.wrapT = RepeatWrapping;
    texture.magFilter = LinearFilter;
    texture.minFilter = LinearMipmapNearestFilter;
    texture.generateMipmaps = true;
    texture.needsUpdate = true;
    return texture;
  }

  /** Paints on for about `ms`. Returns whether the picture has changed, which it does once, when it is complete. */
  paint(ms: number): boolean {
    if (this.row >= this.sheet.height) return false;
    const until = performance.now() + ms;
    while (this.row < this.sheet.height && performance.now() < until) {
      this.sheet.paint(this.row, this.row + ROWS_AT_ONCE, 1);
      this.row += ROWS_AT_ONCE;
    }
    if (this.row < this.sheet.height) return false;
    const { pixels, width, height } = this.sheet;
    this.texture.dispose(); // another size
    this.texture.image = { data: pixels, width, height };
    this.texture.needsUpdate = true;
    return true;
  }

  /** The same picture in a material of its own, which can fade. */
  twin(): Paper {
    return new Paper(this.sheet, false, this.texture);
  }

  fade(opacity: number): void {
    this.material.uniforms.opacity!.value = opacity;
    this.material.transparent = opacity < 1;
    this.material.depthWrite = opacity > 0.5;
  }

  get complete(): boolean {
    return this.row >= this.sheet.height;
  }

  dispose(): void {
    this.texture.dispose();
    this.material.dispose();
  }
}

/** Every so manyth pixel of every so manyth row. */
export function thinned(
  { pixels, width, height }: Pick<Sheet, "pixels" | "width" | "height">,
  step: number,
): { data: Uint8Array<ArrayBuffer>; width: number; height: number } {
  const [wide, high] = [Math.ceil(width / step), Math.ceil(height / step)];
  const data = new Uint8Array(4 * wide * high);
  for (let y = 0; y < high; y++)
    for (let x = 0; x < wide; x++) {
      const from = 4 * (y * step * width + x * step);
      data.set(pixels.subarray(from, from + 4), 4 * (y * wide + x));
    }
  return { data, width: wide, height: high };
}
