import type { Control, Message } from "../../wire/messages.ts";
import type { Ask, Reply, Triple } from "../engine.ts";

/** The types of the npm package in integrations/wasm. The static page loads the package itself at run time. */
export type { LiveRun, Punctura } from "punctura";

/** studio.json in the static folder, by tools/build_backend/static_page.py: what the server of a studio would know. */
export interface StudioData {
  readonly version: string;
  readonly protocol: number;
  /** The ready scenes, with the tables of their files. */
  readonly scenes: readonly { readonly name: string; readonly title: string; readonly tables: Tables }[];
  /** The name of the scene that runs first. */
  readonly first: string;
  /** What happened at a fault, and what to do, by its name. */
  readonly faults: Readonly<Record<string, readonly [string, string]>>;
  /** Of a new run whose force waits for a person. */
  readonly still_off: string;
}
export type Tables = Readonly<Record<string, unknown>>;

/** This page is the only one, so it always has control. */
export const IN_CONTROL: Control = { kind: "control", holder: 1, you: true, hand: null };

/** From the page to the worker. */
export type ToWorker =
  | { readonly start: string }
  | { readonly id: number; readonly ask: Ask }
  | { readonly run: number; readonly position: Triple; readonly axis: Triple; readonly buttons: number }
  | { readonly visible: boolean };

/** From the worker to the page. `failed`: why nothing can run. */
export type FromWorker =
  | { readonly message: Message }
  | { readonly reply: Reply }
  | { readonly frame: ArrayBuffer }
  | { readonly failed: string };
