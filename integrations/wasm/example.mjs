// A needle goes into skin at 5 mm/s: depth and force. In Node: node example.mjs. In a page: example.html.
import { load } from "./punctura.mjs";

const { Insertion } = await load();
const insertion = new Insertion({
  needle: { diameter: 1.08e-3, tip_angle: 0.28 },
  coupling: { stiffness: 400, damping: 1 },
  servo: { rate: 1600 },
  membrane: [
    {
      name: "skin",
      stiffness: 570,
      precompression: 0.41,
      friction: 0.2,
      thickness: 1e-3,
      point: [0, 0, 0],
      inward_normal: [0, -1, 0],
    },
  ],
});
for (let k = 0; k <= 3200; ++k) {
  const depth = (5e-3 * k) / 1600 - 2e-3;
  const [, force] = insertion.step([0, -depth, 0], [0, -1, 0]);
  if (k % 160 === 0) console.log(`${(1e3 * depth).toFixed(1)} mm  ${force.toFixed(3)} N`);
}
insertion.free();
