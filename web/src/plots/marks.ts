import { dropText } from "../state/scale.ts";
import type { MembraneEvent } from "../wire/messages.ts";

/** The label of a pop: the drop of the model's force. scale: of the felt force. */
export const popLabel = (event: MembraneEvent, scale: number): string =>
  `pop${scale === 1 ? " " : ", "}${dropText(event.drop, scale)}`;
