import type { App } from "../state/app.ts";
import { codeOf } from "../wire/ticks.ts";

export const FAULTED = codeOf("state", "faulted");

/** The number of the servo's present state (see STATES); -1 without a connection or a tick. */
export function servoState(app: App): number {
  const { history } = app.live;
  if (!history.length || app.connection.value.state !== "open") return -1;
  // A device that has stopped sends no tick with the state "faulted".
  return app.fault.value ? FAULTED : (history.byteRow("state", history.end - 1)[0] ?? 0);
}
