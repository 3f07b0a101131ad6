import { afterEach, expect, it, vi } from "vitest";
import { everyFrame, keptList, named } from "../src/panel.ts";

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

it("a list that is shown again does not touch what is the same: a button that is pressed keeps its click", () => {
  const children: Entry[] = [];
  const moved: string[] = [];
  class Entry {
    constructor(readonly text: string) {}
    remove(): void {
      children.splice(children.indexOf(this), 1);
    }
  }
  const insertBefore = (entry: Entry, next: Entry | null): void => {
    moved.push(entry.text);
    if (children.includes(entry)) entry.remove();
    children.splice(next ? children.indexOf(next) : children.length, 0, entry);
  };
  const host = { children, insertBefore } as unknown as Element;
  const show = keptList<{ text: string }>(host, ({ text }) => new Entry(text) as unknown as Element);
  const texts = (all: readonly string[]): { text: string }[] => all.map((text) => ({ text }));
  show(texts(["a", "b", "c"]));
  moved.length = 0;
  for (const now of [
    ["a", "b", "c"],
    ["b", "c"],
    ["new", "b", "other", "c"],
  ]) {
    const [b, c] = [children.find(({ text }) => text === "b"), children.find(({ text }) => text === "c")];
    show(texts(now));
    expect(children.map(({ text }) => text)).toEqual(now);
    expect(children.find(({ text }) => text === "b")).toBe(b);
    expect(children.find(({ text }) => text === "c")).toBe(c);
  }
  expect(moved).toEqual(["new", "other"]);
});
