import { mm, newton } from "../format.ts";
import { turns } from "../frames.ts";
import { button, element, everyFrame, type Panel } from "../panel.ts";
import { feltForce, feltShare, MODEL_FORCE, scaleOf } from "../state/scale.ts";
import { hiddenOf } from "./curves.ts";
import { ForceDepthDrawing, forceDepthCurves } from "./force_depth_drawing.ts";
import type { Area, ForceDepthPicture } from "./force_depth_picture.ts";
import { difference } from "./gather.ts";
import { keyTick } from "./keys.ts";
import { legend } from "./kit/legend.ts";
import { type Box, Surface } from "./kit/surface.ts";
import { type Theme, watchTheme } from "./kit/theme.ts";
import { nameOf } from "./names.ts";
import { reading } from "./reading.ts";
import { plotsOf } from "./shared.ts";
import { choice, menu, pauseButton, saveMenu, scaleChip } from "./toolbar.ts";

const REDRAW_INTERVAL = 250; // ms, at least, between two drawings of the background
const ALL = "all"; // membranes; longer words are cut off in a narrow panel
const PICK_RADIUS = 60; // px: the pointer reads the nearest point within this distance

/** Force against depth: all ticks of the window, on top of each membrane's friction band. */
export const forceDepthPlot: Panel = (host, app) => {
  const plots = plotsOf(app);
  const hidden = hiddenOf(app);
  const curves = legend(hidden);
  const drawing = new ForceDepthDrawing();
  let theme: Theme | null = null;
  let chosen: number | null = null;
  let zoom: Area | null = null;
  let pointed: { tick: number; membrane: number } | null = null;
  let changes = 0;
  let laws = 0;

  const setZoom = (area: Area | null): void => {
    zoom = area;
    reset.hidden = area === null;
    changes++;
  };
  const which = choice("Membrane", [["all", ALL]], "all", (value) => {
    chosen = value === "all" ? null : Number(value);
    setZoom(null);
  });
  const reset = button("Reset zoom", "Reset the zoom (0, or double click)", () => setZoom(null));
  reset.hidden = true;
  const picture = (): ForceDepthPicture => ({
    source: plots.source,
    window: plots.window,
    shown: plots.zoom.value ? null : plots.source.present(),
    chosen,
    overlay: app.overlay.value,
    comparison: app.comparison.value,
    zoom,
    oldest: plots.source.live ? 0.2 : 0.55, // a run that stands still is studied as a whole, so it fades less
    pointed,
    hidden,
  });
  const readout = element("span", { class: "plot-readout" });
  const compared = element("span", { class: "plot-compared" });
  const spoken = element("p", { class: "only-read", "aria-live": "polite" });
  const body = element("div", { class: "plot-body" });
  host.append(
    element(
      "div",
      { class: "plot-bar" },
      element("h2", {}, "Against depth"),
      which.select,
      scaleChip(plots),
      element("span", { class: "plot-gap" }),
      reset,
      menu("Curves", "Show and hide curves", curves.root),
      pauseButton(app),
      saveMenu({
        name: "force-depth",
        plots,
        theme: () => theme!,
        membranes: () => chosen,
        size: () => [surface.width, surface.height],
        draw: (pen) => drawing.draw(pen, picture(), theme!),
        curves: () => forceDepthCurves(picture(), theme!).filter(({ id }) => hidden.shows(id)),
      }),
    ),
    body,
    element("div", { class: "plot-foot" }, readout, compared),
    spoken,
  );

  const surface = new Surface(
    body,
    "Force against depth. Arrow keys read values along the motion, 0 resets the zoom.",
    {
      boxDrawn: ({ x1, y1, x2, y2 }: Box) => {
        const { x, y } = drawing.pane;
        const across = [x.value(Math.min(x1, x2)), x.value(Math.max(x1, x2))] as const;
        const up = [y.value(Math.max(y1, y2)), y.value(Math.min(y1, y2))] as const;
        if (Math.abs(x2 - x1) > 4 && Math.abs(y2 - y1) > 4) setZoom({ x: across, y: up });
      },
      doubleClicked: () => setZoom(null),
      key: (event) => {
        if (event.key === "0") setZoom(null);
        else if (!keyTick(event, plots, app)) return false;
        const tick = plots.source.shown();
        if (tick !== null && plots.pointedBy === "keys")
          spoken.textContent = reading(plots.source, tick, plots.noDepth);
        return true;
      },
    },
  );
  watchTheme((now) => {
    theme = now;
    changes++;
  });
  hidden.ids.watch(() => changes++);
  const name = (i: number): string => nameOf(plots.source, i);
  const offer = (): void => {
    const { membranes } = plots.source.history;
    const names = plots.source.scene.value?.membranes.map((m) => m.name) ?? [];
    const entries = Array.from({ length: Math.max(membranes, names.length) }, (_, i) => [String(i), name(i)] as const);
    if (chosen !== null && chosen >= entries.length) chosen = null;
    which.offer([["all", ALL], ...entries], chosen === null ? "all" : String(chosen));
    changes++;
  };
  let leave = (): void => {};
  app.source.watch((source) => {
    leave();
    setZoom(null);
    const ends = [source.scene.watch(offer), source.laws.watch(() => laws++)];
    leave = () => {
      for (const end of ends) end();
    };
  });
  app.overlay.watch(() => changes++);
  app.comparison.watch(() => changes++);

  const point = (now: ForceDepthPicture): void => {
    if (surface.pointer) {
      pointed = drawing.nearest(now, surface.pointer.x, surface.pointer.y, PICK_RADIUS);
      plots.point(pointed?.tick ?? null, "depth");
    } else {
      if (plots.pointedBy === "depth" && document.activeElement !== surface.canvas) plots.point(null, "depth");
      const tick = plots.source.pointed.value;
      pointed = tick === null ? null : { tick, membrane: chosen ?? strongest(now, tick) };
    }
  };
  const read = (): void => {
    const { history } = plots.source;
    const tick = pointed?.tick ?? plots.source.shown();
    const m = pointed?.membrane ?? chosen;
    if (plots.noDepth || tick === null || m === null || tick < history.first || tick >= history.end) {
      readout.textContent = "";
      return;
    }
    const depth = history.row("depth", tick)[m]!;
    const force = -history.row("axial_force", tick)[m]!;
    const felt = `${feltForce(scaleOf(plots.source, tick))} ${newton(force * feltShare(history, tick), 3)}`;
    const at =
      `${name(m)}: ${mm(depth, 3)}, ${MODEL_FORCE} ${newton(force, 3)}, ${felt} ` +
      `at ${history.timeOf(tick).toFixed(4)} s`;
    readout.textContent = at.replaceAll("-", "−");
  };
  const turn = turns();
  let seen = "";
  let still = "";
  let comparedAt = 0;
  let back = "";
  let backEnd = 0;
  let backAt = 0;
  let wait = 0;
  everyFrame((time) => {
    if (!theme || surface.width < 40) return;
    const window = plots.update();
    const { source } = plots;
    const { history } = source;
    const backState = [
      ...[changes, surface.sizes, history.generation, source.events.value.length, laws, source.title, plots.span.value],
      ...[plots.zoom.value?.from, plots.zoom.value?.to, source.live ? "" : source.cursor.value],
    ].join(" ");
    const held = `${backState} ${surface.changes} ${source.pointed.value}`;
    const { end } = window;
    const state = `${held} ${end}`;
    if (state === seen || (held === still && !turn(time))) return; // new ticks alone wait for their turn
    seen = state;
    still = held;
    const now = picture();
    // The fading history is costly to draw. The longer one drawing takes, the longer the wait before the next.
    if (backState !== back || (end !== backEnd && time - backAt > wait)) {
      const began = performance.now();
      back = backState;
      backEnd = end;
      backAt = time;
      drawing.arrange(now, surface.width, surface.height, time / 1e3);
      drawing.drawBack(surface.beginBack(), now, theme);
      curves.show(forceDepthCurves(now, theme));
      wait = Math.max(REDRAW_INTERVAL, 10 * (performance.now() - began));
    }
    point(now);
    const pen = surface.begin();
    drawing.drawFront(pen, picture(), backEnd, theme);
    if (surface.box) {
      const { x1, y1, x2, y2 } = surface.box;
      pen.box(Math.min(x1, x2), Math.min(y1, y2), Math.abs(x2 - x1), Math.abs(y2 - y1), theme.accent, 0.2);
    }
    read();
    if (time - comparedAt > 250) {
      comparedAt = time;
      const apart = difference({ history, first: window.first, end: window.end });
      compared.textContent = apart
        ? `solvers differ by ${newton(apart.rms, 4)} rms, ${newton(apart.largest, 3)} at most`
        : "";
    }
  });
};

/** The membrane with the largest axial force at a tick. */
function strongest({ source }: ForceDepthPicture, tick: number): number {
  const { history } = source;
  if (tick < history.first || tick >= history.end) return 0;
  const force = history.row("axial_force", tick);
  let best = 0;
  for (let i = 1; i < force.length; i++) if (Math.abs(force[i]!) > Math.abs(force[best]!)) best = i;
  return best;
}
