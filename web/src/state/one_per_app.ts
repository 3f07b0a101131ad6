import type { App } from "./app.ts";

/** What several panels share without knowing each other: made for the page by whoever asks first. */
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
