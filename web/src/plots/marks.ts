import type { MembraneEvent } from "../wire/messages.ts";

/** The label of a pop: the drop of the force. */
export const popLabel = (event: MembraneEvent): string => `pop −${Math.abs(event.drop).toFixed(2)} N`;
