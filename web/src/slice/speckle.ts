// A block of speckle that repeats in all directions: bytes on a logarithmic scale, with a mean near 128. It is fixed in
// the tissue, so it moves with the tissue.
/** Voxels of the block, powers of two. The last direction is the depth. */
export const ACROSS = 64;
export const DEEP = 128;
/** Voxels per mm. */
export const ACROSS_PER_MM = 7;
export const DEEP_PER_MM = 11;
const SEED = 0x9e3779b9;

/** Uniform numbers from 0 to 1, the same in every browser (a xorshift generator). */
function random(seed: number): () => number {
  let state = seed;
  return () => {
    state ^= state << 13;
    state ^= state >>> 17;
    state ^= state << 5;
    return (state >>> 0) / 0x1_0000_0000;
  };
}

/** A moving mean of 2 n + 1 voxels along one direction of the block, which repeats. */
function blurred(block: Float32Array, n: number, stride: number, count: number): Float32Array {
  const made = new Float32Array(block.length);
  const period = stride * count;
  for (let start = 0; start < block.length; start++) {
    if (Math.floor(start / stride) % count !== 0) continue;
    const value = (i: number): number => block[start + ((i + count) % count) * stride]!;
    let sum = 0;
    for (let i = -n; i <= n; i++) sum += value(i);
    for (let i = 0; i < count; i++) {
      made[start + i * stride] = sum;
      sum += value(i + n + 1) - value(i - n);
    }
  }
  return period > 0 ? made : block;
}

function field(next: () => number): Float32Array {
  let block: Float32Array = new Float32Array(ACROSS * ACROSS * DEEP);
  for (let i = 0; i < block.length; i++) block[i] = next() + next() + next() - 1.5;
  for (let pass = 0; pass < 2; pass++) {
    block = blurred(block, 1, 1, DEEP);
    block = blurred(block, 2, DEEP, ACROSS);
    block = blurred(block, 2, DEEP * ACROSS, ACROSS);
  }
  return block;
}

let known: Uint8Array | null = null;

/** The block. Echoes of many small scatterers add up: the size of a sum with random phases. */
export function speckle(): Uint8Array {
  if (known) return known;
  const next = random(SEED);
  const real = field(next);
  const imaginary = field(next);
  let power = 0;
  for (let i = 0; i < real.length; i++) power += real[i]! ** 2 + imaginary[i]! ** 2;
  power /= real.length;
  known = new Uint8Array(real.length);
  for (let i = 0; i < real.length; i++) {
    const level = Math.log((real[i]! ** 2 + imaginary[i]! ** 2) / power + 0.02);
    known[i] = Math.max(0, Math.min(255, 150 + 38 * level));
  }
  return known;
}
