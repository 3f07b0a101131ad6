import { unbroken } from "../../format.ts";
import { element } from "../../panel.ts";
import type { Remark, Result } from "../../wire/messages.ts";

/** What to change next time, and what went well. Empty if the coach has nothing to say. */
export function coachPart({ coaching }: Pick<Result, "coaching">): HTMLElement[] {
  const part = (kind: string, title: string, remarks: readonly Remark[]): HTMLElement[] =>
    remarks.length === 0
      ? []
      : [
          element(
            "section",
            { class: `coach ${kind}` },
            element("h3", {}, title),
            element("ul", {}, ...remarks.map(({ text }) => element("li", {}, unbroken(text)))),
          ),
        ];
  return [
    ...part("change", "What to change next time", coaching.change),
    ...part("good", "What went well", coaching.good),
  ];
}
