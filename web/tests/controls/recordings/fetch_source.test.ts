import { expect, test } from "vitest";
import { fetchSource } from "../../../src/controls/recordings/fetch_source.ts";
import type { RecordingEntry } from "../../../src/wire/messages.ts";
import { expected, makeFrame } from "../../wire/frame.ts";
import { fakeFiles } from "../support/fake_files.ts";
import { prefixed } from "../support/prefixed.ts";
import scene from "../support/scene.json";

const entry: RecordingEntry = {
  name: "a b.1",
  title: "A b",
  started: "2026-11-21T17:00:00Z",
  seconds: 0.01,
  ticks: 10,
  lost: 6,
  scene: "Venipuncture",
  exercise: "",
  finished: true,
};
const event = {
  kind: "event", what: "pop", membrane: 0, name: "skin", tick: 12, time: 0.0075, depth: 0,
  force_before: 1, force_after: 0.5, drop: 0.5,
}; // biome-ignore format: a record
const overview = { info: {}, scene, events: [event], ticks: 10, first_tick: 4 };
const stream = prefixed([
  makeFrame({ first: 4, count: 5, membranes: 3 }),
  makeFrame({ first: 15, count: 5, membranes: 3, lost: 6 }),
]);
const path = "/api/recordings/a%20b.1";
const files = { [path]: overview, [`${path}/ticks`]: new Response(stream) };

test("a recording is a source with its scene, events and every tick, lost ones empty", async () => {
  const told: number[] = [];
  const { source, left } = await fetchSource(fakeFiles(files), entry, ({ bytes, total }) => told.push(bytes / total));
  expect([source.live, source.title, left]).toEqual([false, "A b", 0]);
  expect(source.scene.value?.name).toBe("Venipuncture");
  expect(source.events.value).toHaveLength(1);
  const { history } = source;
  expect([history.first, history.end]).toEqual([4, 20]);
  expect(history.row("depth", 8)[1]).toBe(expected("depth", 8, 1));
  expect(history.row("depth", 10)[1]).toBeNaN();
  expect(history.timeOf(14)).toBeCloseTo(14 / 1600, 9);
  expect(history.row("depth", 15)[2]).toBe(expected("depth", 15, 2));
  expect(told.at(-1)).toBe(1);
});

test("a missing recording gives a message", async () => {
  await expect(fetchSource(fakeFiles({}), entry, () => {})).rejects.toThrow("There is no such file any more.");
});

test("a stream that ends early is an error", async () => {
  const broken = { ...files, [`${path}/ticks`]: new Response(stream.slice(0, -8)) };
  await expect(fetchSource(fakeFiles(broken), entry, () => {})).rejects.toThrow("ends within a frame");
});
