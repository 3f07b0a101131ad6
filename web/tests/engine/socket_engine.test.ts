import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import type { Triple } from "../../src/engine/engine.ts";
import { prefixed } from "../controls/support/prefixed.ts";
import { makeFrame } from "../wire/frame.ts";
import { bench } from "./fake_socket.ts";

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

/** A message with several frames: python/punctura/studio/hub.py. */
const several = (frames: readonly ArrayBuffer[]): ArrayBuffer =>
  Uint8Array.of(...new TextEncoder().encode("PNTS"), ...prefixed(frames)).buffer;

const DOWN: Triple = [0, -1, 0];

describe("the connection", () => {
  it("is opened at the page's own host, with the token", () => {
    const { socket, connections } = bench("s3cret");
    expect(socket().url).toBe("ws://127.0.0.1:8765/ws");
    expect(socket().protocols).toEqual(["punctura.v1", "token.s3cret"]);
    expect(socket().binaryType).toBe("arraybuffer");
    expect(connections).toEqual([{ state: "connecting", attempt: 1 }]);
    socket().opens();
    expect(connections.at(-1)).toEqual({ state: "open" });
  });

  it("comes back by itself, with growing waits, and says so", () => {
    const { sockets, socket, connections } = bench();
    const waits: number[] = [];
    for (let i = 0; i < 8; i++) {
      socket().closes(1006);
      const now = connections.at(-1)!;
      expect(now.state).toBe("lost");
      if (now.state !== "lost") return;
      waits.push(now.retryInMs);
      vi.advanceTimersByTime(now.retryInMs - 1);
      expect(sockets).toHaveLength(i + 1);
      vi.advanceTimersByTime(1);
      expect(sockets).toHaveLength(i + 2);
      expect(connections.at(-1)).toEqual({ state: "connecting", attempt: i + 2 });
    }
    expect(waits).toEqual([250, 500, 1000, 2000, 4000, 8000, 8000, 8000]);
  });

  it("waits little again once a connection has lasted, not once it has merely opened", () => {
    const { socket, connections } = bench();
    const loseAfter = (ms: number): number => {
      socket().opens();
      vi.advanceTimersByTime(ms);
      socket().closes(1006);
      const now = connections.at(-1)!;
      if (now.state !== "lost") throw new Error(now.state);
      vi.advanceTimersByTime(now.retryInMs);
      return now.retryInMs;
    };
    expect([loseAfter(10), loseAfter(10), loseAfter(10)]).toEqual([250, 500, 1000]);
    expect([loseAfter(5000), loseAfter(10)]).toEqual([250, 250]);
  });

  it("is not tried again where the server refuses the token, and the reason is told", async () => {
    const asked: unknown[] = [];
    const { sockets, socket, connections } = bench("old", async (path, init) => {
      asked.push([path, init?.headers]);
      return new Response("This needs the token of this run.\n", { status: 401 });
    });
    socket().closes(1006);
    await vi.advanceTimersByTimeAsync(60_000);
    expect(asked).toEqual([["/api/access", { Authorization: "Bearer old" }]]);
    expect(connections.at(-1)).toEqual({ state: "refused", reason: "This needs the token of this run." });
    expect(sockets).toHaveLength(1);
  });

  it.each([
    ["does not answer", () => Promise.reject(new TypeError("no server"))],
    ["is too busy", async () => new Response("Too many requests.", { status: 429 })],
    ["lets the page in", async () => new Response(null, { status: 204 })],
  ])("is tried again where the server %s", async (_name, fetch) => {
    const { sockets, socket, connections } = bench("abc", fetch);
    socket().closes(1006);
    await vi.advanceTimersByTimeAsync(250);
    expect(sockets).toHaveLength(2);
    expect(connections.at(-1)).toEqual({ state: "connecting", attempt: 2 });
  });

  it("that once was open is not asked about", async () => {
    const asked: string[] = [];
    const { socket } = bench("abc", async (path) => {
      asked.push(path);
      return new Response("", { status: 401 });
    });
    socket().opens();
    socket().closes(1006);
    await vi.advanceTimersByTimeAsync(100);
    expect(asked).toEqual([]);
  });

  it("ends with stop, whatever comes after", () => {
    const { engine, sockets, socket, connections, messages } = bench();
    socket().opens();
    const said = connections.length;
    engine.stop();
    expect(socket().closedWith).toBe(1000);
    socket().says({ kind: "notice", text: "late" });
    socket().closes(1000);
    vi.advanceTimersByTime(60_000);
    expect([sockets.length, connections.length, messages.length]).toEqual([1, said, 0]);
  });
});

describe("a request", () => {
  it("gets the reply with its id, in whatever order they come", async () => {
    const { engine, socket } = bench();
    socket().opens();
    const arm = engine.ask({ do: "arm" });
    const load = engine.ask({ do: "load", scene: "epidural" });
    const [first, second] = socket().sent;
    expect(first).toMatchObject({ do: "arm" });
    expect(second).toMatchObject({ do: "load", scene: "epidural" });
    socket().says({ kind: "reply", id: second!.id, ok: false, text: "no such scene" });
    socket().says({ kind: "reply", id: first!.id, ok: true });
    expect(await load).toMatchObject({ ok: false, text: "no such scene" });
    expect(await arm).toMatchObject({ ok: true });
  });

  it("is rejected when the connection goes before the reply, and without a connection at once", async () => {
    const { engine, socket } = bench();
    await expect(engine.ask({ do: "arm" })).rejects.toThrow("no connection");
    socket().opens();
    const asked = engine.ask({ do: "arm" });
    socket().closes(1006);
    await expect(asked).rejects.toThrow("went before");
  });
});

describe("the target", () => {
  it("is sent once a frame: the last", () => {
    const { engine, socket, nextFrame } = bench();
    socket().opens();
    for (let i = 1; i <= 5; i++) engine.target(i, [0, i, 0], DOWN);
    expect(socket().sent).toHaveLength(0);
    nextFrame();
    expect(socket().sent).toEqual([{ do: "target", run: 5, position: [0, 5, 0], axis: [0, -1, 0], buttons: 0 }]);
    nextFrame();
    expect(socket().sent).toHaveLength(1);
    engine.target(5, [0, 6, 0], DOWN, 1);
    nextFrame();
    expect(socket().sent[1]).toMatchObject({ position: [0, 6, 0], buttons: 1 });
  });

  it("is dropped without a connection: an old one must not be obeyed later", () => {
    const { engine, socket, nextFrame } = bench();
    engine.target(0, [0, 1, 0], DOWN);
    nextFrame();
    socket().opens();
    nextFrame();
    expect(socket().sent).toHaveLength(0);
  });
});

describe("what comes in", () => {
  it("goes to the page as it is", () => {
    const { socket, messages, batches } = bench();
    socket().opens();
    socket().says({ kind: "control", holder: 1, you: true, hand: null });
    socket().says(makeFrame({ first: 320, count: 26, membranes: 2 }));
    expect(messages).toEqual([{ kind: "control", holder: 1, you: true, hand: null }]);
    expect(batches[0]).toMatchObject({ firstTick: 320, count: 26, membranes: 2 });
  });

  it("is answered for each message with ticks, and a message can have several frames", () => {
    const { socket, batches } = bench();
    socket().opens();
    const frames = [makeFrame({ first: 0, count: 3, membranes: 1 }), makeFrame({ first: 3, count: 2, membranes: 1 })];
    socket().says(frames[0]);
    socket().says(several(frames));
    socket().says({ kind: "notice", text: "no ticks" });
    expect(batches.map(({ firstTick }) => firstTick)).toEqual([0, 0, 3]);
    expect(socket().sent).toEqual([{ do: "took" }, { do: "took" }]);
  });

  it.each([
    ["several frames cut off", several([makeFrame({ count: 3, membranes: 1 })]).slice(0, 100), "within a frame"],
    ["ticks cut off", makeFrame({ count: 3, membranes: 1 }).slice(0, 200), "ends within"],
    ["ticks with a tail", new Uint8Array(new ArrayBuffer(48)).fill(0).buffer, "wrong magic number"],
    ["an empty frame", new ArrayBuffer(0), "too short"],
    ["no JSON", "{", "no JSON"],
    ["a number", "7", "without a kind"],
    ["an unknown kind", '{"kind":"toString"}', "unknown kind"],
    ["a reply to an unknown request", '{"kind":"reply","id":77,"ok":true}', "unknown request 77"],
  ])("is reported, once, and not fatal where it is %s", (_name, data, words) => {
    const { socket, messages, batches, connections } = bench();
    socket().opens();
    for (let i = 0; i < 3; i++) socket().says(data);
    expect(messages).toHaveLength(1);
    expect(messages[0]).toMatchObject({ kind: "notice", text: expect.stringContaining(words) as string });
    socket().says(makeFrame({ count: 1, membranes: 1 }));
    expect(batches).toHaveLength(1);
    expect(connections.at(-1)).toEqual({ state: "open" });
  });
});
