/** Frames as a recording's ticks come: python/punctura/studio/recorded.py. */
export function prefixed(frames: readonly ArrayBuffer[]): Uint8Array<ArrayBuffer> {
  const sizes = frames.map((frame) => 4 + Math.ceil(frame.byteLength / 4) * 4);
  const all = new Uint8Array(sizes.reduce((sum, size) => sum + size, 0));
  let at = 0;
  frames.forEach((frame, i) => {
    new DataView(all.buffer).setUint32(at, frame.byteLength, true);
    all.set(new Uint8Array(frame), at + 4);
    at += sizes[i]!;
  });
  return all;
}
