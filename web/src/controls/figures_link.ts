import { element } from "../panel.ts";
import type { App } from "../state/app.ts";

const PATH = "/figures/";

/** A link to the page of the paper's figures, or the command that makes the page. */
export function figuresLink(app: App): HTMLElement {
  const link = element("a", { href: app.api.address(PATH), target: "_blank", rel: "noopener" }, "Figures of the paper");
  const made = element("span", { hidden: true }, link, ": K06 Figs. 3, 5, 10, 11 and 12, computed by this model.");
  const missing = element(
    "span",
    {},
    "The paper’s figures, computed by this model: ",
    element("code", {}, "punctura reproduce"),
    " makes the page.",
  );
  app.hello.watch((hello) => {
    made.hidden = !hello?.figures;
    missing.hidden = hello?.figures ?? false;
  });
  return element("p", { class: "quiet pad figures" }, made, missing);
}
