import type { Message } from "../../wire/messages.ts";
import type { Ask, Reply, Triple } from "../engine.ts";

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
