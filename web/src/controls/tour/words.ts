import type { Progress } from "./progress.ts";

/** The names of the four things to do. */
export const NAMES = ["Touch", "Feel it hold", "Pop", "Draw back"] as const;

/**
 * What to do next, as the needle is now. skin: name of the first membrane. mouse: this page moves the needle, not a
 * device. stage: the tabs are on the bench.
 */
export function instruction(progress: Progress, skin: string, mouse: boolean, stage = false): string {
  const { done, ready, inside, fall } = progress;
  if (!ready) return "First draw the needle out of the tissue.";
  if (!inside && done < 3) {
    return mouse
      ? `Drag in the view, along the needle, into the ${skin}: push until it gives.`
      : `Move your stylus along the needle, into the ${skin}: push until it gives.`;
  }
  if (done < 2) return "Push on: the tissue holds the needle back, and the force grows.";
  if (done === 2) return "Push until it gives.";
  if (inside && done > 3) return "The needle is in the tissue again.";
  if (!inside) {
    const where = stage ? "Under More, the" : "The";
    return `That is all: the needle is out. ${where} tab Exercises has tasks that get harder.`;
  }
  return `It gave: the ${fall}. Now draw the needle all the way out.`;
}
