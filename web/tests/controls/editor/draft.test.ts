import { afterEach, beforeEach, expect, test, vi } from "vitest";
import { Draft } from "../../../src/controls/editor/draft.ts";
import { App } from "../../../src/state/app.ts";
import type { SceneView } from "../../../src/wire/messages.ts";
import { FakeEngine } from "../support/fake_engine.ts";
import { fakeFiles } from "../support/fake_files.ts";
import scene from "../support/scene.json";

const FRICTION = ["membrane", 1, "friction"];
const settle = (): Promise<unknown> => vi.advanceTimersByTimeAsync(20);

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

function begin(): { app: App; engine: FakeEngine; draft: Draft } {
  const engine = new FakeEngine(scene as unknown as SceneView, 1);
  const app = new App(engine, fakeFiles({}));
  const draft = new Draft(app);
  app.start();
  return { app, engine, draft };
}

test("a drag sends whole tables, only some of them, but always the last", async () => {
  const { engine, draft, app } = begin();
  for (let i = 1; i <= 50; i++) draft.set(FRICTION, 0.08 + i / 1000);
  await settle();
  expect(engine.asked.length).toBe(2);
  expect(engine.asked.at(-1)).toMatchObject({
    do: "edit",
    tables: { name: "Venipuncture", membrane: { 1: { friction: 0.13 } } },
  });
  expect(app.live.scene.value?.number).toBe(2);
  expect(draft.can.value).toEqual({ undo: true, redo: false, reset: true });
  draft.undo();
  expect(draft.at(FRICTION)).toBe(0.08);
  await settle();
  expect(draft.can.value).toEqual({ undo: false, redo: true, reset: false });
});

test("a refused change stays, with its problem, until it is corrected", async () => {
  const { draft, app } = begin();
  draft.set(FRICTION, 3.6);
  await settle();
  expect(draft.problems.value[0]?.path).toBe("membrane[1].friction");
  expect(app.live.scene.value?.number).toBe(0);
  draft.set(FRICTION, 0.2);
  await settle();
  expect(draft.problems.value).toEqual([]);
});

test("another scene takes the draft's place; the same one, as for a recording, keeps what can be undone", async () => {
  const { draft, engine, app } = begin();
  draft.set(FRICTION, 0.2);
  await settle();
  engine.emit({ kind: "scene", scene: { ...app.live.scene.value!, number: 0 }, new_run: true, run: 1 });
  expect(draft.can.value.undo).toBe(true);
  engine.emit({
    kind: "scene",
    scene: { ...app.live.scene.value!, number: 0, tables: { name: "other" } },
    new_run: true,
    run: 1,
  });
  expect(draft.tables.value).toEqual({ name: "other" });
  expect(draft.can.value).toEqual({ undo: false, redo: false, reset: false });
});
