import { newton } from "../../format.ts";
import type { Progress } from "./progress.ts";

/** The names of the four things to do. */
export const NAMES = ["Touch", "Feel it hold", "Pop", "Draw back"] as const;

/** What to do next. skin: name of the first membrane. mouse: this page moves the needle, not a device. */
export function instruction({ done, ready, pop, fallen }: Progress, skin: string, mouse: boolean): string {
  if (!ready) return "First draw the needle out of the tissue.";
  switch (done) {
    case 0:
      return mouse
        ? `Drag in the view, along the needle, until its tip touches the ${skin}.`
        : `Move your stylus until the needle touches the ${skin}.`;
    case 1:
      return "Push on: the tissue holds the needle back, and the force grows.";
    case 2:
      return "Push until it gives.";
    case 3:
      return `It gave: the ${fallen} fell by ${newton(Math.abs(pop?.drop ?? 0))}. Now draw the needle all the way out.`;
    default:
      return "That is all: the needle is out. The Exercises tab has tasks that get harder.";
  }
}
