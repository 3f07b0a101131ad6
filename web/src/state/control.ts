import type { App } from "./app.ts";

/**
 * Who has control, in words without a full stop. Whoever controls a simulated device moves its needle; a real one is
 * moved by a hand.
 */
export function controlWords({ control, hello }: Pick<App, "control" | "hello">): string {
  const { you, holder } = control.value;
  const simulated = hello.value?.device.simulated ?? true;
  if (you) return simulated ? "You move the needle" : "You have control";
  if (holder === null) return simulated ? "Nobody moves the needle" : "No page has control";
  return simulated ? "Another page moves the needle" : "Another page has control";
}
