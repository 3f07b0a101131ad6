import { element } from "../../panel.ts";

export interface ReportLine {
  readonly text: string;
  /** Goes to the field, where there is one that does not show. */
  readonly go?: () => void;
}

/** What is wrong that no field in sight tells. Empty: nothing is there. */
export function report(): { root: HTMLElement; show(lines: readonly ReportLine[]): void } {
  const root = element("div", { class: "report", role: "alert", hidden: true });
  return {
    root,
    show: (lines) => {
      root.hidden = lines.length === 0;
      root.replaceChildren(
        ...lines.map(({ text, go }) =>
          element(
            "p",
            {},
            text,
            ...(go ? [" ", element("button", { type: "button", class: "link", onclick: go }, "Show")] : []),
          ),
        ),
      );
    },
  };
}
