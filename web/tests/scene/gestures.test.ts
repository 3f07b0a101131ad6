import { beforeEach, describe, expect, it } from "vitest";
import { gestures } from "../../src/scene/gestures.ts";

/** As much of a canvas as gestures need. */
class FakeCanvas extends EventTarget {
  readonly dataset: Record<string, string> = {};
  getBoundingClientRect(): { left: number; top: number } {
    return { left: 100, top: this.top };
  }
  top = 50;
  readonly captured = new Set<number>();
  setPointerCapture(id: number): void {
    this.captured.add(id);
  }
  hasPointerCapture(id: number): boolean {
    return this.captured.has(id);
  }
  releasePointerCapture(id: number): void {
    this.captured.delete(id);
  }
}

let canvas: FakeCanvas;
let log: string[];
let free: boolean;
let drag: ReturnType<typeof gestures>;

function send(type: string, fields: Record<string, unknown>): Event {
  const event = new Event(type, { cancelable: true });
  canvas.dispatchEvent(Object.assign(event, { pointerId: 1, button: 0, shiftKey: false, ...fields }));
  return event;
}
const down = (x: number, y: number, more = {}): Event => send("pointerdown", { clientX: x, clientY: y, ...more });
const move = (x: number, y: number, more = {}): Event => send("pointermove", { clientX: x, clientY: y, ...more });
const up = (more = {}): Event => send("pointerup", more);

beforeEach(() => {
  canvas = new FakeCanvas();
  log = [];
  free = true;
  drag = gestures(canvas as unknown as HTMLElement, {
    grab: (x, y, sideways) => {
      log.push(`grab ${x} ${y}${sideways ? " sideways" : ""}`);
      return free;
    },
    drag: (x, y) => log.push(`drag ${x} ${y}`),
    release: () => log.push("release"),
    orbit: (dx, dy) => log.push(`orbit ${dx} ${dy}`),
    pan: (dx, dy) => log.push(`pan ${dx} ${dy}`),
    zoom: (factor) => log.push(`zoom ${factor.toFixed(2)}`),
    push: (depth) => {
      if (free) log.push(`push ${depth.toFixed(2)}`);
      return free;
    },
    plunge: (pixels) => log.push(`plunge ${pixels}`),
  });
});

describe("a gesture over the view", () => {
  it("with the left button or one finger drags the needle", () => {
    down(150, 80);
    move(155, 90);
    up();
    move(200, 200);
    expect(log).toEqual(["grab 50 30", "drag 55 40", "release"]);
  });

  it("with the right button goes round the scene, and never touches the needle", () => {
    const how = { button: 2 };
    down(150, 80, how);
    move(155, 90, how);
    up(how);
    expect(log).toEqual(["orbit 5 10"]);
  });

  it("that drags the needle does not move it when the view moves down on the page", () => {
    down(150, 80);
    canvas.top = 90;
    move(155, 90);
    up();
    down(150, 120);
    expect(log).toEqual(["grab 50 30", "drag 55 40", "release", "grab 50 30"]);
  });

  it("with Shift drags the needle sideways, too", () => {
    down(150, 80, { shiftKey: true });
    move(155, 90, { shiftKey: true });
    expect(log).toEqual(["grab 50 30 sideways", "drag 55 40"]);
  });

  it("with the middle button moves the picture", () => {
    down(150, 80, { button: 1 });
    move(155, 90);
    expect(log).toEqual(["pan 5 10"]);
  });

  it("two fingers let the needle go, zoom and go round; the finger that stays does not take the needle", () => {
    down(150, 80, { pointerId: 1 });
    down(250, 80, { pointerId: 2 });
    move(350, 80, { pointerId: 2 });
    up({ pointerId: 2 });
    move(160, 80, { pointerId: 1 });
    up({ pointerId: 1 });
    expect(log).toEqual(["grab 50 30", "release", "zoom 2.00", "orbit 50 0", "orbit 10 0"]);
  });

  it("that is cancelled lets the needle go, until the button is pressed anew", () => {
    down(150, 80);
    drag.cancel();
    move(155, 90);
    move(400, 400);
    up();
    expect(log).toEqual(["grab 50 30", "release"]);
    expect(canvas.captured.size).toBe(0);
    down(150, 80);
    move(155, 90);
    expect(log.slice(2)).toEqual(["grab 50 30", "drag 55 40"]);
  });

  it("goes round where the needle cannot be taken", () => {
    free = false;
    down(150, 80);
    move(155, 80);
    expect(log).toEqual(["grab 50 30", "orbit 5 0"]);
  });

  it("with the wheel goes along the needle, with Ctrl zooms, and does not scroll the page", () => {
    const wheel = (fields: object): Event =>
      send("wheel", { deltaY: 100, deltaMode: 0, ctrlKey: false, metaKey: false, ...fields });
    expect(wheel({}).defaultPrevented).toBe(true);
    expect(wheel({ ctrlKey: true }).defaultPrevented).toBe(true);
    free = false;
    wheel({});
    expect(log).toEqual(["push 0.40", "zoom 0.55", "zoom 0.89"]);
  });

  it("with the wheel and Alt pushes the plunger, and neither moves the needle nor zooms", () => {
    const wheel = (fields: object): Event =>
      send("wheel", { deltaY: 100, deltaMode: 0, ctrlKey: false, metaKey: false, altKey: true, ...fields });
    expect(wheel({}).defaultPrevented).toBe(true);
    wheel({ deltaY: -3, deltaMode: 1 });
    free = false;
    wheel({});
    expect(log).toEqual(["plunge 100", "plunge -54", "plunge 100"]);
  });
});
