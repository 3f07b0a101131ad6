import type { Message } from "./messages.ts";

const KINDS: Readonly<Record<Message["kind"], true>> = {
  hello: true,
  scene: true,
  laws: true,
  control: true,
  status: true,
  fault: true,
  event: true,
  estimate: true,
  recording: true,
  exercise: true,
  sitting: true,
  reply: true,
  notice: true,
};

/**
 * Parses a message of the server. Returns a sentence if it is invalid. Only the kind is checked: the server defines
 * the types.
 */
export function parseMessage(text: string): Message | string {
  let value: unknown;
  try {
    value = JSON.parse(text);
  } catch {
    return "a message that is no JSON";
  }
  if (typeof value !== "object" || value === null || !("kind" in value)) return "a message without a kind";
  if (typeof value.kind !== "string" || !Object.hasOwn(KINDS, value.kind)) {
    return `a message of an unknown kind, ${JSON.stringify(value.kind)}`;
  }
  return value as Message;
}
