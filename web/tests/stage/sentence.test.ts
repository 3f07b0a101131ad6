import { beforeEach, expect, it, vi } from "vitest";
import type { EngineListener } from "../../src/engine/engine.ts";
import { Sentence } from "../../src/stage/sentence.ts";
import { App } from "../../src/state/app.ts";
import type { Band } from "../../src/tissue/bands.ts";
import type { ExerciseStatus, Hello } from "../../src/wire/messages.ts";

vi.stubGlobal("document", { cookie: "" });

const SKIN: Band = { name: "skin", top: 0, bottom: 2, tone: null, membrane: 0 };
const INSIDE = { depth: 1, force: 0.2 };

let app: App;
let server: EngineListener;

const control = (you: boolean, holder: number | null): void =>
  server.message({ kind: "control", you, holder, hand: null, viewers: 2 } as never);

beforeEach(() => {
  const start = (listener: EngineListener): void => {
    server = listener;
  };
  app = new App({ studio: true, start } as never);
  app.start();
  server.connection({ state: "open" });
  server.message({ kind: "hello", device: { simulated: true, model: "Omni" } } as unknown as Hello);
});

it("a page that looks on tells what happens, and not only that it has no control", () => {
  const sentence = new Sentence(app);
  control(false, 3);
  expect(sentence.words([SKIN], INSIDE)).toEqual({ text: "The tip is in the skin, 1\u00a0mm deep.", takeOver: false });
  // The button Take control stands beside it.
  expect(sentence.words([SKIN], null)).toEqual({ text: "Another page moves the needle.", takeOver: true });
  app.exercise.value = { running: true, instruction: "Push slowly." } as ExerciseStatus;
  expect(sentence.words([SKIN], INSIDE)).toEqual({ text: "Push slowly.", takeOver: false });
});

it("tells who could move the needle, and that the studio is gone", () => {
  const sentence = new Sentence(app);
  control(false, null);
  expect(sentence.words([SKIN], null)).toEqual({ text: "Nobody moves the needle.", takeOver: true });
  for (const session of [null, { sentence: "Push.", gone: "Weg." }]) {
    app.sitting.value = session as never;
    server.connection({ state: "open" });
    if (session) expect(sentence.words([SKIN], null).text).toBe("Push.");
    server.connection({ state: "closed", retry: 0 } as never);
    expect(sentence.words([SKIN], INSIDE).text).toBe(session?.gone ?? "The studio is not connected.");
  }
});
