import { type App, onePerApp } from "../state/app.ts";
import { Signal } from "../state/signal.ts";

/**
 * N, of a thumb that pushes by a key or a button. Illustrative: where the ready epidural gives way, 2 mL have left the
 * syringe after some 0.8 s, so that somebody who sees it can let go in time.
 */
export const FIRM = 3;
const REPEAT_MS = 400; // the server lets go after 1 s of silence
const STEP = 0.1; // N; smaller changes of a trigger are not sent
const MS_PER_WHEEL_PIXEL = 2.5; // a notch has about 100 pixels, so four notches a second are a steady push
const WHEEL_MS = 400; // the longest push that is left when the wheel stops

/** The simulated thumb on the plunger. It pushes as long as something holds it: a key, a button, a trigger, a wheel. */
export class Thumb {
  /** N, what is sent now; 0 if nothing pushes. */
  readonly force = new Signal(0);
  private readonly held = new Map<string, number>();
  private sent = 0;
  /** ms, until which the wheel pushes. */
  private wheelEnd = 0;

  constructor(private readonly app: App) {
    app.run.watch(() => this.letGo());
    app.control.watch((control) => {
      if (!control.you) this.letGo();
    });
    // A key that is released in another window is not seen here.
    globalThis.addEventListener?.("blur", () => this.letGo());
    globalThis.addEventListener?.("keyup", ({ key }) => {
      if (key === "Alt") this.turn(0);
    });
  }

  /** Whether the scene has a plunger that this page can push. */
  get there(): boolean {
    const { source, control, hello } = this.app;
    if (hello.value?.second_device) return false; // it pushes the plunger
    return source.value.live && control.value.you && Boolean(source.value.scene.value?.syringe);
  }

  /** by: what pushes, so that a key that is released does not end the push of a trigger. force: N; 0 lets go. */
  push(by: string, force: number, now = performance.now()): void {
    if (force > 0 && this.there) this.held.set(by, force);
    else this.held.delete(by);
    this.send(now);
  }

  /** Pushes while the wheel turns inwards, and somewhat longer; turned back, or when Alt is released, it lets go. */
  turn(pixels: number, now = performance.now()): void {
    const left = Math.max(0, this.wheelEnd - now);
    this.wheelEnd = pixels > 0 ? now + Math.min(WHEEL_MS, left + pixels * MS_PER_WHEEL_PIXEL) : 0;
    this.push("wheel", pixels > 0 ? FIRM : 0, now);
  }

  /** Call in each frame: says again that the thumb still pushes, or lets go if the page shows another run. */
  renew(now: number): void {
    if (this.held.has("wheel") && now >= this.wheelEnd) this.push("wheel", 0, now);
    if (!this.there) this.letGo();
    else if (this.force.value > 0 && now - this.sent > REPEAT_MS) this.send(now, true);
  }

  private letGo(): void {
    this.held.clear();
    this.wheelEnd = 0;
    this.send(performance.now());
  }

  private send(now: number, again = false): void {
    const wanted = Math.max(0, ...this.held.values());
    const changed = wanted === 0 ? this.force.value !== 0 : Math.abs(wanted - this.force.value) >= STEP;
    if (!changed && !again) return;
    this.force.value = wanted;
    this.sent = now;
    if (this.app.connection.value.state === "open") void this.app.ask({ do: "push_plunger", force: wanted });
  }
}

export const thumbOf = onePerApp((app) => new Thumb(app));
