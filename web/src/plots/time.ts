import { turns } from "../frames.ts";
import { button, element, everyFrame, type Panel } from "../panel.ts";
import { hiddenOf } from "./curves.ts";
import { keyTick } from "./keys.ts";
import { MARGIN } from "./kit/axes.ts";
import { legend } from "./kit/legend.ts";
import { Surface } from "./kit/surface.ts";
import { type Theme, watchTheme } from "./kit/theme.ts";
import { popCallout } from "./pop_callout.ts";
import { reading } from "./reading.ts";
import { plotsOf, SPANS, type Span } from "./shared.ts";
import { TimeDrawing, timeCurves } from "./time_drawing.ts";
import type { TimePicture } from "./time_picture.ts";
import { choice, menu, pauseButton, saveMenu, scaleChip } from "./toolbar.ts";
import { nearestTick, Scrolled } from "./window.ts";

const TAIL = 800; // ticks without states, limits and marks in the background, at most

/** Force and depth against time, one above the other. */
export const timePlots: Panel = (host, app) => {
  const plots = plotsOf(app);
  const hidden = hiddenOf(app);
  const curves = legend(hidden);
  const drawing = new TimeDrawing();
  let theme: Theme | null = null;
  let changes = 0;

  const spans = choice(
    "Time shown",
    SPANS.map((span) => [String(span), `${span} s`] as const),
    String(plots.span.value),
    (value) => {
      plots.resetZoom();
      plots.span.value = Number(value) as Span;
    },
  );
  const reset = button("Reset zoom", "Reset the zoom (0, or double click)", () => plots.resetZoom());
  plots.zoom.watch((zoom) => {
    reset.hidden = zoom === null;
    drawing.forget();
    changes++;
  });
  const picture = (): TimePicture => ({
    source: plots.source,
    window: plots.window,
    pointed: plots.source.pointed.value,
    cursor: plots.source.cursor.value,
    hidden,
    noDepth: plots.noDepth,
    comparison: app.comparison.value,
  });
  const body = element("div", { class: "plot-body" });
  const spoken = element("p", { class: "only-read", "aria-live": "polite" });
  host.append(
    element(
      "div",
      { class: "plot-bar" },
      element("h2", {}, "Against time"),
      spans.select,
      scaleChip(plots),
      element("span", { class: "plot-gap" }),
      reset,
      menu("Curves", "Show and hide curves", curves.root),
      pauseButton(app),
      saveMenu({
        name: "force-and-depth",
        plots,
        theme: () => theme!,
        membranes: () => null,
        size: () => [surface.width, surface.height],
        draw: (pen) => drawing.draw(pen, picture(), theme!),
        curves: () => timeCurves(picture(), theme!).filter(({ id }) => hidden.shows(id)),
      }),
    ),
    body,
    spoken,
  );
  const surface = new Surface(
    body,
    "Force and depth against time. Arrow keys move the moment, with Shift by one tick. " +
      "Plus and minus zoom, 0 resets, Space pauses.",
    {
      boxDrawn: ({ x1, x2 }) => {
        const { x } = drawing.force;
        const [from, to] = [x.value(Math.min(x1, x2)), x.value(Math.max(x1, x2))];
        if (to - from > 2e-3) plots.zoomTo(from, to);
      },
      doubleClicked: () => plots.resetZoom(),
      key: (event) => {
        if (event.key === "0") {
          plots.resetZoom();
          return true;
        }
        const taken = keyTick(event, plots, app);
        const tick = plots.source.shown();
        if (taken && tick !== null && plots.pointedBy === "keys")
          spoken.textContent = reading(plots.source, tick, plots.noDepth);
        return taken;
      },
    },
    true,
  );
  watchTheme((now) => {
    theme = now;
    changes++;
  });
  const callOut = popCallout(body, app);
  hidden.ids.watch(() => changes++);
  app.comparison.watch(() => changes++);

  const point = (): void => {
    const { pointer } = surface;
    const { x, left, width } = drawing.force;
    if (pointer && pointer.x >= left && pointer.x <= left + width) {
      plots.point(nearestTick(plots.source.history, x.value(pointer.x)), "time");
    } else if (plots.pointedBy === "time") plots.point(null, "time");
  };

  const turn = turns();
  const scrolled = new Scrolled();
  let seen = "";
  let still = "";
  let back = "";
  let backEnd = 0;
  const drawLines = (now: TimePicture, pixels: number | null, theme: Theme): void => {
    const { end } = now.window;
    if (pixels === null) drawing.drawLines(surface.beginLines(), now, theme);
    else {
      const edge = drawing.edgeOf(now, scrolled.end);
      surface.scrollLines(pixels, MARGIN.left, edge, (pen) => drawing.drawNewLines(pen, now, edge, theme));
    }
    scrolled.end = end;
  };
  everyFrame((time) => {
    if (!theme || surface.width < 40) return;
    plots.width = surface.width - MARGIN.left - MARGIN.right;
    plots.ratio = surface.ratio;
    const window = plots.update();
    const { from, to, first, end } = window;
    const { source } = plots;
    const { history } = source;
    const marks = source.events.value.length + source.punctures.value.length;
    const looks = `${changes} ${surface.sizes} ${history.generation} ${source.live}`;
    const backState = `${looks} ${marks} ${from} ${to}`;
    const held = `${looks} ${marks} ${surface.changes} ${source.cursor.value} ${source.pointed.value}`;
    const state = `${held} ${from} ${to} ${first} ${end}`;
    if (state === seen || (held === still && !turn(time))) return; // new ticks alone wait for their turn
    seen = state;
    still = held;
    const now = picture();
    const pixels = scrolled.step(looks, window, (plots.width / (to - from)) * surface.ratio);
    const added = pixels === null ? null : scrolled.end;
    const ranged = drawing.arrange(now, surface.width, surface.height, time / 1e3, added);
    if (backState !== back || ranged || end - backEnd > TAIL) {
      back = backState;
      backEnd = end;
      drawing.drawBack(surface.beginBack(), now, theme);
      curves.show(timeCurves(now, theme));
    }
    drawLines(now, ranged ? null : pixels, theme);
    point();
    callOut(drawing.force);
    const pen = surface.begin();
    drawing.drawFront(pen, picture(), theme);
    if (surface.box) {
      const { x1, x2 } = surface.box;
      const { top } = drawing.force;
      const height = drawing.depth.bottom - top;
      pen.box(Math.min(x1, x2), top, Math.abs(x2 - x1), height, theme.accent, 0.2);
    }
  });
};
