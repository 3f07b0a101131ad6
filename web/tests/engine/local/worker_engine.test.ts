import { afterEach, beforeEach, expect, it, vi } from "vitest";
import { type Connection, DONE } from "../../../src/engine/engine.ts";
import type { FromWorker, ToWorker } from "../../../src/engine/local/core.ts";
import { WorkerEngine, type WorkerPort } from "../../../src/engine/local/worker_engine.ts";
import type { Message } from "../../../src/wire/messages.ts";
import type { TickBatch } from "../../../src/wire/ticks.ts";
import { makeFrame } from "../../wire/frame.ts";

let sent: ToWorker[];
let port: WorkerPort;
let ended: boolean;
let states: Connection["state"][];
let messages: Message[];
let batches: TickBatch[];
let engine: WorkerEngine;
const document = new EventTarget() as EventTarget & { visibilityState: string };

const say = (data: FromWorker): void => port.onmessage?.({ data } as MessageEvent<FromWorker>);

beforeEach(() => {
  document.visibilityState = "visible";
  vi.stubGlobal("document", document);
  sent = [];
  states = [];
  messages = [];
  batches = [];
  ended = false;
  port = {
    onmessage: null,
    onerror: null,
    postMessage: (data) => sent.push(data),
    terminate: () => {
      ended = true;
    },
  };
  engine = new WorkerEngine("https://example.org/page/", () => port);
  engine.start({
    connection: ({ state }) => states.push(state),
    message: (message) => messages.push(message),
    ticks: (batch) => batches.push(batch),
  });
});
afterEach(() => {
  engine.stop();
  vi.unstubAllGlobals();
});

it("is connected when the worker says hello", () => {
  expect(sent).toEqual([{ start: "https://example.org/page/" }]);
  expect(states).toEqual(["connecting"]);
  say({ message: { kind: "hello" } as Message });
  expect(states).toEqual(["connecting", "open"]);
  say({ frame: makeFrame({ count: 13, membranes: 2, run: 4 }) });
  expect(batches).toMatchObject([{ count: 13, membranes: 2, run: 4 }]);
});

it("gives each request its reply", async () => {
  const first = engine.ask({ do: "arm" });
  const second = engine.ask({ do: "load", scene: "none" });
  expect(sent.slice(1)).toEqual([
    { id: 1, ask: { do: "arm" } },
    { id: 2, ask: { do: "load", scene: "none" } },
  ]);
  say({ reply: { kind: "reply", id: 2, ...DONE, ok: false, text: "no" } });
  say({ reply: { kind: "reply", id: 1, ...DONE } });
  expect(await first).toMatchObject({ ok: true });
  expect(await second).toMatchObject({ ok: false, text: "no" });
});

it("tells why nothing runs, and refuses further requests", async () => {
  const waiting = engine.ask({ do: "arm" });
  say({ failed: "studio.json is missing beside the page: status 404" });
  await expect(waiting).rejects.toThrow("studio.json is missing");
  expect(states.at(-1)).toBe("refused");
  expect(ended).toBe(true);
  await expect(engine.ask({ do: "arm" })).rejects.toThrow("does not run");
});

it("tells the worker when nobody looks at the page, also at its start", () => {
  document.visibilityState = "hidden";
  document.dispatchEvent(new Event("visibilitychange"));
  engine.target(3, [0, 1, 2], [0, -1, 0]);
  expect(sent.slice(1)).toEqual([{ visible: false }, { run: 3, position: [0, 1, 2], axis: [0, -1, 0], buttons: 0 }]);
  engine.stop();
  sent = [];
  engine.start({ connection: () => {}, message: () => {}, ticks: () => {} });
  expect(sent).toEqual([{ start: "https://example.org/page/" }, { visible: false }]);
});
