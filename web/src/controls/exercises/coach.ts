import { unbroken } from "../../format.ts";
import { element } from "../../panel.ts";
import type { Result } from "../../wire/messages.ts";

/**
 * One thing to change next time, and one that went well. Empty if the coach has nothing to say. watch: shows the worst
 * moment, at this time of the run (s).
 */
export function coachPart(
  { coaching }: Pick<Result, "coaching">,
  watch?: (time: number) => HTMLElement,
): HTMLElement[] {
  const [change, good] = [coaching.change[0], coaching.good[0]];
  const when = change?.time ?? null;
  const part = (kind: string, title: string, text: string, ...more: HTMLElement[]): HTMLElement =>
    element("section", { class: `coach ${kind}` }, element("h3", {}, title), element("p", {}, unbroken(text)), ...more);
  return [
    ...(change
      ? [part("change", "What to change next time", change.text, ...(watch && when !== null ? [watch(when)] : []))]
      : []),
    ...(good ? [part("good", "What went well", good.text)] : []),
  ];
}
