import { element, type Panel } from "../panel.ts";
import { watchBlock } from "./blocked.ts";

/** Demonstrates a fault without harm: the simulated device reports one position that is not a number. */
export const faultTrial: Panel = (host, app) => {
  const button = element(
    "button",
    { type: "button", class: "button", onclick: () => void app.ask({ do: "trip_fault" }) },
    "Try a fault",
  );
  const words =
    "The simulated device reports a position that is not a number. The force ends at once and stays off until Reset.";
  const part = element(
    "section",
    { class: "fault-trial", hidden: true },
    element("p", { class: "quiet" }, words),
    button,
  );
  host.append(part);
  app.hello.watch((hello) => {
    part.hidden = !hello?.device.simulated;
  });
  watchBlock(app, (block) => {
    button.disabled = block !== null;
  });
};
