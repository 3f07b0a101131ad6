import "./bench.css";
import { arrange } from "./controls/arrange/arrange.ts";
import { editorPanel } from "./controls/editor.ts";
import { exercisesPanel, whenOneRuns } from "./controls/exercises.ts";
import { faultTrial } from "./controls/fault_banner.ts";
import { handPanel } from "./controls/hand.ts";
import { headerBar } from "./controls/header.ts";
import { healthPanel } from "./controls/health.ts";
import { labPanel } from "./controls/lab.ts";
import { momentLine } from "./controls/moment_line.ts";
import { withStudio } from "./controls/needs_studio.ts";
import { phasesPanel } from "./controls/phases.ts";
import { playerBar } from "./controls/recordings/player.ts";
import { recordingsPanel } from "./controls/recordings.ts";
import { stateButton } from "./controls/state_button.ts";
import { tabs } from "./controls/tabs.ts";
import { tour } from "./controls/tour.ts";
import { type Panel, placed } from "./panel.ts";
import { forceDepthPlot } from "./plots/force_depth.ts";
import { timePlots } from "./plots/time.ts";
import type { App } from "./state/app.ts";

/**
 * Every panel beside the view, which is there already: header; the phases below the view; plots in the middle; the
 * tabs to the right. `arrange` lets the panels change size and place.
 */
export function bench(root: HTMLElement, app: App): void {
  const place = (name: string, label: string, panel: Panel): HTMLElement => placed(name, label, panel, app);
  const view = root.querySelector<HTMLElement>(":scope > .view")!;
  momentLine(view, app);
  root.prepend(place("header", "Run", headerBar));
  const phases = place("phases", "Membranes", phasesPanel);
  phases.tabIndex = 0; // so that the arrow keys can scroll it
  view.after(
    place("force-depth", "Force against depth", forceDepthPlot),
    phases,
    place("time-plots", "Force and depth against time", timePlots),
    place(
      "side",
      "Controls",
      tabs([
        ["hand", "Hand", handPanel],
        ["scene", "Scene", editorPanel],
        ["recordings", "Recordings", withStudio("Recordings are files on a disk. They need", recordingsPanel)],
        ["exercises", "Exercises", withStudio("Exercises and their results need", exercisesPanel), whenOneRuns],
        ["lab", "Lab", labPanel],
        [
          "health",
          "Health",
          (host, app) => {
            healthPanel(host, app);
            faultTrial(host, app);
          },
        ],
      ]),
    ),
    place("player", "Replay", playerBar),
  );
  const force = stateButton(app); // of a device, on the stage; a simulated force reaches no hand
  root.querySelector(".stage-buttons")!.append(force);
  app.hello.watch((hello) => {
    force.hidden = hello?.device.simulated !== false;
  });
  arrange(root, app);
  tour(root, app);
}
