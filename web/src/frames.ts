/** What a panel draws. now: ms. painted: whether the browser paints next; false for a picture between two frames. */
export type Draw = (now: number, painted: boolean) => void;

const BUSY_MS = 22; // between two pictures with new ticks, on average
const PAUSE_MS = 250; // a longer gap is a pause, and not a late picture
const TURN_MS = 66;

const draws = new Set<Draw>();
const between = new MessageChannel();
let handle = 0;
let fresh = false; // ticks have come since the last picture
let before = 0; // time of the last picture with new ticks
let interval = 0; // mean of the last intervals between such pictures, ms
let taken = false; // somebody had the turn in this picture
let refused: Part[] = []; // in this picture
let first: Part | undefined; // waited longest of those that the last picture refused; only this one has the turn

/** A part of the page that can wait. last: when it had its last turn, ms. */
interface Part {
  last: number;
}

/**
 * Calls once per animation frame while the page is visible. The returned function ends that, also within a call.
 *
 * If the page is late, the browser begins the next animation frame before it hands over the ticks that have come
 * meanwhile. Such a frame has nothing new to draw, and the next one is up to 17 ms later. So after a frame without
 * ticks, all draw once more as soon as the waiting ticks are taken.
 */
export function everyFrame(draw: Draw): () => void {
  draws.add(draw);
  if (draws.size === 1) handle = requestAnimationFrame(frame);
  return () => {
    draws.delete(draw);
    if (draws.size === 0) cancelAnimationFrame(handle);
  };
}

/** Ticks have come. */
export function ticksCame(): void {
  fresh = true;
}

/** Whether pictures with new ticks come late. Then parts that can wait are drawn less often. */
export const busy = (): boolean => interval > BUSY_MS;

/**
 * A turn for a part of the page that can wait. The returned function says whether it is drawn now: always, except
 * while the page is busy; then every TURN_MS at most, not together with another such part, and whoever has waited
 * longest goes first.
 */
export function turns(): (now: number) => boolean {
  const part: Part = { last: Number.NEGATIVE_INFINITY };
  return (now) => {
    if (busy() && (taken || now - part.last < TURN_MS || (first && first !== part))) {
      refused.push(part);
      return false;
    }
    taken = true;
    part.last = now;
    return true;
  };
}

function frame(now: number): void {
  if (!fresh) between.port2.postMessage(null); // behind the messages that wait
  run(now, true);
  if (draws.size > 0) handle = requestAnimationFrame(frame);
}

between.port1.onmessage = () => {
  if (fresh) run(performance.now(), false);
};

function run(now: number, painted: boolean): void {
  if (fresh) {
    const gap = now - before;
    if (gap < PAUSE_MS) interval += (gap - interval) / 8;
    before = now;
  }
  fresh = taken = false;
  first = refused.sort((a, b) => a.last - b.last)[0];
  refused = [];
  for (const draw of [...draws]) if (draws.has(draw)) draw(now, painted);
}
