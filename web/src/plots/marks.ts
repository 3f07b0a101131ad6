import type { History } from "../state/history.ts";
import { dropText } from "../state/scale.ts";
import type { MembraneEvent } from "../wire/messages.ts";

/** The label of a pop: "pop −0.79 N", or "pop, model force −0.79 N". history: of the pop's run. */
export const popLabel = (event: MembraneEvent, history: History): string => {
  const drop = dropText(history, event);
  return `pop${drop.startsWith("−") ? " " : ", "}${drop}`;
};
