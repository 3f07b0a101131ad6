import { faultBanner } from "./controls/fault_banner.ts";
import { notices } from "./controls/notices.ts";
import { placed } from "./panel.ts";
import { viewWithSlice } from "./slice/view_with_slice.ts";
import { sitting } from "./stage/sitting.ts";
import { stage } from "./stage/stage.ts";
import type { App } from "./state/app.ts";
import { pageOf } from "./state/page.ts";
import { remembered } from "./state/remembered.ts";

/** The page: the view, with the stage over it; and the bench around it, which is loaded when something needs it. */
export function layout(root: HTMLElement, app: App): void {
  root.append(
    placed("fault", "Fault", faultBanner, app),
    placed("view", "Needle and membranes", viewWithSlice, app),
    placed("notices", "Messages", notices, app),
  );
  stage(root, app);
  sitting(root, app);
  loadBench(root, app);
}

/** The bench also has the force's button, the replay, the results of exercises, the sound and the gamepad. */
function loadBench(root: HTMLElement, app: App): void {
  let begun = false;
  const load = (needed: boolean): void => {
    if (!needed || begun || app.sitting.value) return;
    begun = true;
    void import("./bench.ts").then(
      ({ bench }) => bench(root, app),
      () => {
        begun = false;
        app.notify("The bench could not be loaded. Press More once more when the studio is connected again.");
      },
    );
  };
  pageOf(app).watch((page) => load(page === "bench"));
  app.source.watch(({ live }) => load(!live));
  app.exercise.watch((exercise) => load(exercise?.running ?? false));
  const device = (): void => load(app.hello.value?.device.simulated === false);
  app.hello.watch(device);
  app.sitting.watch(device);
  app.live.events.watch((events) => load(events.some(({ what }) => what === "pop")));
  window.addEventListener("gamepadconnected", () => load(true));
  // The scene comes after a participant's session, in which no sound tells of a pop.
  app.live.scene.watch((scene) => load(scene !== null && remembered("sound") === "on"));
}
