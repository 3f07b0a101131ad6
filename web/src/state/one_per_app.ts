import type { App } from "./app.ts";

/** An object that several panels share: the first panel that asks creates it. */
export function onePerApp<T>(make: (app: App) => T): (app: App) => T {
  const made = new WeakMap<App, { readonly it: T }>();
  return (app) => {
    let kept = made.get(app);
    if (!kept) {
      kept = { it: make(app) };
      made.set(app, kept);
    }
    return kept.it;
  };
}
