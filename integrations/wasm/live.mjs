// A scene on a simulated device in a simulated hand: ticks in blocks, as the studio's page reads them.
import { Handle } from "./memory.mjs";
import { withScene } from "./scene.mjs";

const POSE = 32; // in the scratch memory: position and axis

export const liveRunOf = (memory) => {
  const { c, scratch } = memory;
  const put = (position, axis) => {
    memory.put(position, scratch + POSE);
    memory.put(axis, scratch + POSE + 24);
    return scratch + POSE;
  };

  return class LiveRun {
    #handle;
    constructor(scene, { number = 0, seed = 0, pose = null, after = null } = {}) {
      const at = withScene(memory, scene, (description) =>
        c.live_new(description, number, seed, pose ? put(pose.position, pose.axis) : 0),
      );
      if (!at) throw memory.error(2); // PUNCTURA_BAD_SCENE
      this.#handle = new Handle(at, c.live_free);
      if (after) c.live_go_on_from(at, after.#at);
    }
    free() {
      this.#handle.free();
    }
    get #at() {
      return this.#handle.at;
    }
    arm() {
      c.live_arm(this.#at);
    }
    pause() {
      c.live_pause(this.#at);
    }
    reset() {
      c.live_reset(this.#at);
    }
    trip() {
      c.live_trip(this.#at);
    }
    target(position, axis, buttons = 0) {
      c.live_target(this.#at, put(position, axis), buttons);
    }
    strokes(period) {
      c.live_strokes(this.#at, period);
    }
    get strokesNow() {
      return c.live_strokes_now(this.#at) === 1;
    }
    pushPlunger(force) {
      c.live_push_plunger(this.#at, force);
    }
    compare(on) {
      c.live_compare(this.#at, on ? 1 : 0);
    }
    estimate(on) {
      c.live_estimate(this.#at, on ? 1 : 0);
    }
    exchange(scene) {
      withScene(memory, scene, (description) => memory.must(c.live_exchange(this.#at, description)));
    }
    advance(count) {
      return this.#frame(c.live_advance(this.#at, count, scratch));
    }
    feed(position, axis) {
      const pose = put(position, axis);
      return this.#frame(c.live_feed(this.#at, pose, scratch));
    }
    #frame(at) {
      return memory.bytes(at, memory.view.getUint32(scratch, true));
    }
    get rate() {
      return c.live_rate(this.#at);
    }
    get pose() {
      c.live_pose(this.#at, scratch + POSE);
      return { position: memory.triple(scratch + POSE), axis: memory.triple(scratch + POSE + 24) };
    }
    get scene() {
      return JSON.parse(memory.text(c.live_scene(this.#at)));
    }
    messages() {
      return JSON.parse(memory.text(c.live_messages(this.#at)));
    }
    /** Device and limits of every run. */
    static get about() {
      return JSON.parse(memory.text(c.live_about()));
    }
  };
};
