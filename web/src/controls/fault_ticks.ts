import { element } from "../panel.ts";
import type { App } from "../state/app.ts";
import type { FaultMessage } from "../wire/messages.ts";
import { countText } from "./recordings/words.ts";

/** A link that saves the ticks before a fault; empty if none are kept. */
export function faultTicksLink(app: App, fault: FaultMessage): Node {
  if (fault.kept === 0) return document.createTextNode("");
  const href = app.api.address("/api/fault.csv");
  return element("a", { href, download: "" }, `Save the ${countText(fault.kept)} ticks before the fault (CSV)`);
}
