import { afterEach, expect, it, vi } from "vitest";
import { everyFrame, named } from "../src/panel.ts";

afterEach(() => vi.unstubAllGlobals());

it("a loop of frames that is ended from within a frame draws no more", () => {
  const asked: FrameRequestCallback[] = [];
  vi.stubGlobal("requestAnimationFrame", (step: FrameRequestCallback) => asked.push(step));
  vi.stubGlobal("cancelAnimationFrame", () => {});
  const drawn: number[] = [];
  const end = everyFrame((now) => {
    drawn.push(now);
    if (now === 2) end();
  });
  for (let now = 1; now <= 3; now++) asked[now - 1]?.(now);
  expect(drawn).toEqual([1, 2]);
});

it("a name of any length is cut by the style and whole on hover", () => {
  const host = { classList: new Set<string>(), textContent: "", title: "" };
  named(host as unknown as HTMLElement, "n".repeat(200));
  expect([host.title, host.textContent]).toEqual(Array(2).fill("n".repeat(200)));
  expect(host.classList.has("name")).toBe(true);
});
