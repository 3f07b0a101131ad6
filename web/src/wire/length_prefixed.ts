import { FrameError } from "./ticks.ts";

const LARGEST = 1 << 26; // bytes of one frame
const SEVERAL = 0x53544e50; // "PNTS"

/** Splits a stream of bytes into frames: the length (u32), the frame, and zeros up to a multiple of 4 bytes. */
export class FrameSplitter {
  private rest = new Uint8Array(0);

  /** Adds bytes. Returns the frames that are now complete, each in its own buffer. Throws FrameError. */
  push(bytes: Uint8Array): ArrayBuffer[] {
    const all = joined(this.rest, bytes);
    const view = new DataView(all.buffer, all.byteOffset, all.byteLength);
    const frames: ArrayBuffer[] = [];
    let at = 0;
    while (all.byteLength - at >= 4) {
      const length = view.getUint32(at, true);
      if (length === 0 || length > LARGEST) throw new FrameError(`a frame of ${length} bytes cannot be`);
      const next = at + 4 + Math.ceil(length / 4) * 4;
      if (next > all.byteLength) break;
      frames.push(all.slice(at + 4, at + 4 + length).buffer);
      at = next;
    }
    this.rest = all.subarray(at);
    return frames;
  }

  /** Throws FrameError if the stream ends within a frame. */
  end(): void {
    if (this.rest.byteLength > 0) throw new FrameError("the stream ends within a frame");
  }
}

/** The frames of a message of the socket: one alone, or several behind a word of their own. Throws FrameError. */
export function framesOf(data: ArrayBuffer): ArrayBuffer[] {
  if (data.byteLength < 4 || new DataView(data).getUint32(0, true) !== SEVERAL) return [data];
  const splitter = new FrameSplitter();
  const frames = splitter.push(new Uint8Array(data, 4));
  splitter.end();
  return frames;
}

function joined(left: Uint8Array<ArrayBuffer>, right: Uint8Array): Uint8Array<ArrayBuffer> {
  const all = new Uint8Array(left.byteLength + right.byteLength);
  all.set(left);
  all.set(right, left.byteLength);
  return all;
}
