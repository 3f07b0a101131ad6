import { element, type Panel } from "../panel.ts";

/** A sentence in place of what needs the studio on the user's computer. what: begins the sentence. */
export const needsStudio = (what: string): HTMLElement =>
  element(
    "p",
    { class: "quiet pad needs-studio" },
    `${what} the studio, which this page does not have. Install Punctura on your computer and start `,
    element("code", {}, "punctura run"),
    ".",
  );

/** The panel where there is a studio; elsewhere the sentence. */
export const withStudio =
  (what: string, panel: Panel): Panel =>
  (host, app) => {
    if (app.engine.studio) panel(host, app);
    else host.append(needsStudio(what));
  };
