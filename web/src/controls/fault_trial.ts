import { element, type Panel } from "../panel.ts";
import { watchBlock } from "./blocked.ts";
import { faultTicksLink } from "./fault_ticks.ts";

/** The last fault, and a demonstration without harm: the simulated device reports one position that is not a number. */
export const faultTrial: Panel = (host, app) => {
  const last = element("p", { class: "quiet", hidden: true });
  app.fault.watch((fault) => {
    if (!fault) return;
    last.hidden = false;
    last.replaceChildren(`Last fault: ${fault.reason} `, faultTicksLink(app, fault));
  });
  const button = element(
    "button",
    { type: "button", class: "button", onclick: () => void app.ask({ do: "trip_fault" }) },
    "Try a fault",
  );
  const words =
    "The simulated device reports a position that is not a number. The force ends at once, and stays off until you " +
    "turn it on.";
  const trial = element("div", { hidden: true }, element("p", { class: "quiet" }, words), button);
  host.append(element("section", { class: "fault-trial" }, element("h3", {}, "Faults"), last, trial));
  app.hello.watch((hello) => {
    trial.hidden = !hello?.device.simulated;
  });
  watchBlock(app, (block) => {
    button.disabled = block !== null;
  });
};
