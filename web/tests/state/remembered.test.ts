import { expect, it } from "vitest";
import { remember, remembered } from "../../src/state/remembered.ts";

it("an answer is found again among other cookies, and a missing one is null", () => {
  const jar = { cookie: "other=1; punctura_soundly=off; punctura_sound=on" };
  expect(remembered("sound", jar)).toBe("on");
  expect(remembered("tour", jar)).toBeNull();
});

it("an answer is kept for all ports of this computer, for a year", () => {
  const jar = { cookie: "" };
  remember("sound", "off", jar);
  expect(jar.cookie).toBe("punctura_sound=off; path=/; max-age=31536000; samesite=strict");
});
