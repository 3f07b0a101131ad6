import { arrange } from "./controls/arrange/arrange.ts";
import { editorPanel } from "./controls/editor.ts";
import { exercisesPanel, whenOneRuns } from "./controls/exercises.ts";
import { faultBanner } from "./controls/fault_banner.ts";
import { faultTrial } from "./controls/fault_trial.ts";
import { handPanel } from "./controls/hand.ts";
import { headerBar } from "./controls/header.ts";
import { healthPanel } from "./controls/health.ts";
import { labPanel } from "./controls/lab.ts";
import { momentLine } from "./controls/moment_line.ts";
import { withStudio } from "./controls/needs_studio.ts";
import { notices } from "./controls/notices.ts";
import { phasesPanel } from "./controls/phases.ts";
import { playerBar } from "./controls/recordings/player.ts";
import { recordingsPanel } from "./controls/recordings.ts";
import { tabs } from "./controls/tabs.ts";
import { tour } from "./controls/tour.ts";
import { element, type Panel } from "./panel.ts";
import { forceDepthPlot } from "./plots/force_depth.ts";
import { timePlots } from "./plots/time.ts";
import { viewWithSlice } from "./slice/view_with_slice.ts";
import type { App } from "./state/app.ts";

/** Two panels, one below the other. */
const both =
  (above: Panel, below: Panel): Panel =>
  (host, app) => {
    above(host, app);
    below(host, app);
  };

/** The page: header; the view and the phases to the left; plots in the middle; the tabs to the right. `arrange` lets
 * the panels change size and place. */
export function layout(root: HTMLElement, app: App): void {
  const place = (name: string, label: string, panel: Panel): HTMLElement => {
    const scrolls = name === "phases" && { tabindex: 0 }; // so that the arrow keys can scroll it
    const host = element("section", { class: `panel ${name}`, "aria-label": label, ...scrolls });
    panel(host, app);
    return host;
  };
  root.append(
    place("header", "Run", headerBar),
    place("fault", "Fault", faultBanner),
    place("view", "Needle and membranes", both(viewWithSlice, momentLine)),
    place("phases", "Membranes", phasesPanel),
    place("force-depth", "Force against depth", forceDepthPlot),
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
        ["health", "Health", both(healthPanel, faultTrial)],
      ]),
    ),
    place("player", "Replay", playerBar),
    place("notices", "Messages", notices),
  );
  arrange(root, app);
  tour(root, app);
}
