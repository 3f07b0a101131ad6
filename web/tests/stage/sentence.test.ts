import { beforeEach, expect, it, vi } from "vitest";
import type { Progress } from "../../src/controls/tour/progress.ts";
import type { EngineListener } from "../../src/engine/engine.ts";
import { handOf } from "../../src/hand/hand.ts";
import { Sentence } from "../../src/stage/sentence.ts";
import { App } from "../../src/state/app.ts";
import { Source } from "../../src/state/source.ts";
import type { Band } from "../../src/tissue/bands.ts";
import type { ExerciseStatus, Hello } from "../../src/wire/messages.ts";
import { codeOf } from "../../src/wire/ticks.ts";
import { batch } from "../support/fill_history.ts";

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

it("in an exercise, a page that lost control says so, and each page that nobody is left to move the needle", () => {
  const sentence = new Sentence(app);
  app.exercise.value = { running: true, instruction: "Push slowly." } as ExerciseStatus;
  control(true, 1);
  expect(sentence.words([SKIN], INSIDE)).toEqual({ text: "Push slowly.", takeOver: false });
  control(false, 3);
  expect(sentence.words([SKIN], INSIDE)).toEqual({ text: "Another page moves the needle.", takeOver: true });
  app.run.value++; // the other page's next attempt
  expect(sentence.words([SKIN], INSIDE)).toEqual({ text: "Push slowly.", takeOver: false });
  control(false, null);
  expect(sentence.words([SKIN], INSIDE)).toEqual({ text: "Nobody moves the needle.", takeOver: true });
});

it("a page without control says so when its person drags or presses a key, also in a free run", () => {
  const hand = handOf(app);
  const attempts = [() => hand.grab(), () => hand.moveTo([0, -0.001, 0])];
  for (const exercise of [null, { running: true, instruction: "Push slowly." } as ExerciseStatus])
    for (const attempt of attempts) {
      const sentence = new Sentence(app);
      app.exercise.value = exercise;
      app.run.value++;
      control(false, 3);
      expect(sentence.words([SKIN], INSIDE).takeOver).toBe(false);
      attempt();
      expect(sentence.words([SKIN], INSIDE)).toEqual({ text: "Another page moves the needle.", takeOver: true });
    }
});

it("in a free run, a page that lost control says so", () => {
  const sentence = new Sentence(app);
  control(true, 1);
  sentence.words([SKIN], INSIDE);
  control(false, 3);
  expect(sentence.words([SKIN], INSIDE)).toEqual({ text: "Another page moves the needle.", takeOver: true });
});

it("tells who could move the needle, and that the studio is gone", () => {
  const sentence = new Sentence(app);
  control(false, null);
  expect(sentence.words([SKIN], null)).toEqual({ text: "Nobody moves the needle.", takeOver: true });
  for (const session of [null, { sentence: "Push.", gone: "Weg." }]) {
    app.sitting.value = session as never;
    server.connection({ state: "open" });
    if (session) expect(sentence.words([SKIN], null).text).toBe("Push.");
    server.connection({ state: "lost", reason: "", retryInMs: 250 });
    expect(sentence.words([SKIN], INSIDE).text).toBe(
      session?.gone ??
        "The studio does not answer. If its program has ended, start the studio again " +
          "and open the address that it prints; else this page connects by itself.",
    );
  }
  app.sitting.value = null;
  app.exercise.value = { running: true, instruction: "Push slowly." } as ExerciseStatus;
  server.connection({ state: "lost", reason: "", retryInMs: 500 });
  expect(sentence.words([SKIN], INSIDE).text).toContain("If its program has ended, the attempt is lost: start");
});

it("says that the run goes on only while it does, and what to do when it is refused", () => {
  const sentence = new Sentence(app);
  control(true, 1);
  app.source.value = new Source("Paused", false, 10, null, true);
  expect(sentence.words([SKIN], INSIDE).text).toBe("Paused; the run goes on.");
  server.connection({ state: "lost", reason: "", retryInMs: 250 });
  expect(sentence.words([SKIN], INSIDE).text).toContain("The studio does not answer.");
  server.connection({ state: "refused", reason: "This needs the token" });
  expect(sentence.words([SKIN], INSIDE).text).toBe("This needs the token. Open the address that the studio prints.");
});

it("says that the tour is at its end in the run in which it ended, and in no later one", () => {
  const sentence = new Sentence(app);
  control(true, 1);
  const { live } = app;
  const outside = (from: number): void =>
    live.history.push(batch(from, 2, 1, { phase: () => [codeOf("phase", "outside")] }));
  outside(0);
  sentence.words([SKIN], null);
  Object.assign((sentence as unknown as { progress: Progress }).progress, { done: 4 });
  expect(sentence.words([SKIN], null).text).toContain("That is all: the needle is out.");
  live.history.clear(1);
  outside(0);
  expect(sentence.words([SKIN], null).text).toContain("push until it gives");
});
