import { CanvasTexture, MeshMatcapMaterial, SRGBColorSpace } from "three";

const SIZE = 128;

/** The matcap picture of a polished steel ball in a bright room. It needs no lights and no reflections. */
function ball(shade: number): HTMLCanvasElement {
  const canvas = document.createElement("canvas");
  canvas.width = SIZE;
  canvas.height = SIZE;
  const draw = canvas.getContext("2d");
  if (!draw) return canvas;
  const grey = (level: number, alpha = 1): string => {
    const value = Math.round(255 * Math.min(1, level * shade));
    return `rgba(${value}, ${Math.min(255, value + 3)}, ${Math.min(255, value + 8)}, ${alpha})`;
  };
  const room = draw.createLinearGradient(0, 0, 0, SIZE);
  room.addColorStop(0, grey(0.98));
  room.addColorStop(0.45, grey(0.78));
  room.addColorStop(0.55, grey(0.55));
  room.addColorStop(1, grey(0.42));
  draw.fillStyle = room;
  draw.fillRect(0, 0, SIZE, SIZE);
  // Both sides are darker, so that a shaft looks round.
  const round = draw.createLinearGradient(0, 0, SIZE, 0);
  round.addColorStop(0, grey(0.25, 0.75));
  round.addColorStop(0.2, grey(0.5, 0.25));
  round.addColorStop(0.38, grey(1, 0.75));
  round.addColorStop(0.55, grey(0.8, 0));
  round.addColorStop(0.8, grey(0.4, 0.45));
  round.addColorStop(0.92, grey(0.75, 0.5));
  round.addColorStop(1, grey(0.3, 0.8));
  draw.fillStyle = round;
  draw.fillRect(0, 0, SIZE, SIZE);
  return canvas;
}

/** A steel material; shade: brightness, 1 is bright. */
export function steel(shade: number): MeshMatcapMaterial {
  const matcap = new CanvasTexture(ball(shade));
  matcap.colorSpace = SRGBColorSpace;
  return new MeshMatcapMaterial({ matcap });
}
