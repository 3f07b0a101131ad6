// The page with a made-up run, for looking at panels without a server: never part of the product.
// ?seconds=20 of run are there at once, ?compare=1 shows the other solver, ?overlay=1 an earlier run,
// ?slice=1 opens the slice, ?plots=1 leaves out all but plots and tables.
import "../../src/style.css";
import { healthPanel } from "../../src/controls/health.ts";
import { phasesPanel } from "../../src/controls/phases.ts";
import { layout } from "../../src/layout.ts";
import { element } from "../../src/panel.ts";
import { forceDepthPlot } from "../../src/plots/force_depth.ts";
import { timePlots } from "../../src/plots/time.ts";
import { App } from "../../src/state/app.ts";
import { Source } from "../../src/state/source.ts";
import { FakeEngine } from "./fake_engine.ts";

const asked = new URLSearchParams(location.search);
if (asked.has("slice")) localStorage.setItem("punctura.slice", "open");
const engine = new FakeEngine(Number(asked.get("seconds") ?? 20));
engine.compare = asked.get("compare") === "1";
const app = new App(engine);
const root = document.getElementById("app") as HTMLElement;
if (asked.has("plots")) {
  const panels = { phases: phasesPanel, "force-depth": forceDepthPlot, "time-plots": timePlots };
  for (const [name, panel] of Object.entries(panels)) {
    const host = element("section", { class: `panel ${name}` });
    root.append(host);
    panel(host, app);
  }
  const body = element("div", { class: "tab health" });
  root.append(element("section", { class: "panel side" }, body));
  healthPanel(body, app);
} else layout(root, app);
app.start();
if (asked.has("overlay")) {
  const earlier = new Source("earlier run", false, 16_000);
  const run = new FakeEngine(10, 1.3);
  run.start({ connection: () => {}, message: () => {}, ticks: (batch) => earlier.history.push(batch) });
  run.stop();
  app.overlay.value = earlier;
}
Object.assign(window, { app });
