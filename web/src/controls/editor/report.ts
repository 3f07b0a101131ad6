import { element } from "../../panel.ts";

export interface ReportLine {
  readonly text: string;
  /** Opens the field, if it is hidden. */
  readonly go?: () => void;
}

/** A list of the problems that no visible field shows. Hidden while it is empty. */
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
