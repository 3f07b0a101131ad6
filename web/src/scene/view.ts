import { handOf } from "../hand/hand.ts";
import { thumbOf } from "../hand/thumb.ts";
import { thumbInView } from "../hand/thumb_button.ts";
import { element, everyFrame, type Panel } from "../panel.ts";
import { showLastAgain } from "../pop/again.ts";
import type { App } from "../state/app.ts";
import { asTissue } from "../tissue/layers.ts";
import type { SceneView } from "../wire/messages.ts";
import { OrbitCamera, type Preset } from "./camera.ts";
import { poseBeside } from "./expert.ts";
import { flatGrip } from "./flat_grip.ts";
import { framingOf, isBeside } from "./framing.ts";
import { gestures } from "./gestures.ts";
import { hubInset } from "./hub_inset.ts";
import { viewKeys } from "./keys.ts";
import { Labels } from "./labels.ts";
import { Moment } from "./moment.ts";
import { needleGrip } from "./needle_grip.ts";
import { popRing } from "./pop_ring.ts";
import { probeOf } from "./probe.ts";
import { scaleBar } from "./scale_bar.ts";
import { sentence } from "./sentence.ts";
import { SliceFrame } from "./slice_frame.ts";
import { spoken } from "./spoken.ts";
import { Stage } from "./stage.ts";
import { Theme } from "./theme.ts";
import { gestureHelp, presets, sidewaysButton } from "./view_tools.ts";
import { World } from "./world.ts";

const COARSER =
  "This computer drew fewer than 30 pictures a second, so a moving picture has fewer pixels along each side. " +
  "100 %: all of them.";

/** The 3D view of the needle and the membranes. It draws only after a change, at most once per frame. */
export const view: Panel = (host, app) => {
  const canvas = element("canvas", {
    tabindex: 0, role: "application", "aria-label": "3D view of the needle and the membranes",
    "aria-describedby": "view-help",
  }); // biome-ignore format: short
  const help = gestureHelp();
  host.append(canvas, help);
  thumbInView(host, app);
  const theme = new Theme();
  const orbit = new OrbitCamera();
  const trouble = element("p", { class: "view-trouble", role: "status", hidden: true });
  const coarser = element("p", { class: "view-coarser", hidden: true, title: COARSER });
  host.append(trouble, coarser);
  const showTrouble = (words: string): void => {
    trouble.textContent = words;
    trouble.hidden = words === "";
  };
  let stage: Stage;
  try {
    stage = new Stage(
      canvas,
      host,
      theme,
      () => orbit.resize(host.clientWidth, host.clientHeight),
      (gone) => showTrouble(gone ? "The graphics card is lost. The picture returns with it; the run goes on." : ""),
      (words) => {
        coarser.textContent = words;
        coarser.hidden = words === "";
      },
    );
  } catch {
    canvas.hidden = true;
    help.hidden = true;
    showTrouble("No 3D view: this browser has no WebGL. The slice and everything else work without it.");
    const speak = spoken(host);
    host.tabIndex = 0;
    host.setAttribute("role", "application");
    host.setAttribute("aria-label", "The needle, moved by keys and by a drag");
    viewKeys(host, handOf(app), orbit, () => showLastAgain(app), thumbOf(app));
    const pad = element("div", { class: "view-pad" });
    host.prepend(pad);
    gestures(
      pad,
      flatGrip(app, handOf(app), probeOf(app), thumbOf(app), () => pad.clientWidth),
    );
    followInWords(app, speak);
    return;
  }
  const drawRing = popRing(host); // behind the labels
  const labels = new Labels(host);
  const world = new World(stage, labels, theme);
  const hand = handOf(app);
  const showHub = hubInset(host);
  const drawScale = scaleBar(host);
  const speak = spoken(host);
  const look = (preset: Preset): void => orbit.preset(preset, world.moment.axis, world.moment.tip);
  const bar = presets(host, look, (factor) => orbit.zoom(factor));
  const free = sidewaysButton(bar, hand);
  let covered = 0; // height under the toolbar, px
  new ResizeObserver(() => {
    covered = bar.offsetTop + bar.offsetHeight;
  }).observe(bar);
  const sliceFrame = new SliceFrame(theme, stage.scene);
  const probe = probeOf(app);
  sentence(host, app);
  const drag = gestures(canvas, needleGrip(hand, orbit, world, stage, free, thumbOf(app)));
  app.goal.watch((goal) => world.aim(goal));
  // A drag from the last run would pull the new run's needle to the old place.
  app.run.watch(() => drag.cancel());
  hand.barred.watch((why) => {
    if (why !== null) drag.cancel();
  });
  viewKeys(canvas, hand, orbit, () => showLastAgain(app), thumbOf(app));

  const framing = framingOf(app);
  const frame = (): void => {
    if (!world.extent) return;
    orbit.frame(world.middle, world.extent.radius);
    look(framing.free.value ? "front" : "oblique");
  };
  framing.again.watch(frame);
  framing.onScreen = (point) => world.onScreen(point, orbit.camera);
  let built: SceneView | null = null;
  let placed = true; // with the place of the needle, which the first tick tells
  const build = (scene: SceneView): void => {
    built = scene;
    if (!world.build(framing.free.value ? asTissue(scene) : scene)) return;
    placed = false;
    settle();
  };
  const settle = (): void => {
    frame();
    if (framing.free.value) orbit.enclose(world.outline(), framing.free.value);
    orbit.settle();
    stage.stale = true;
  };

  framing.free.watch((free) => {
    const wide = free === null ? "no" : isBeside(free) ? "left" : "both";
    const turns = world.wide !== wide;
    world.wide = wide;
    if (turns) built = null; // the stage draws sheets as tissue
    if (turns) settle();
    stage.stale = true;
  });
  const tellStage = (): void => {
    const depths = world.depths(orbit.camera);
    if (!depths?.equals(framing.depths.value)) framing.depths.value = depths;
    canvas.dataset.needle = world
      .needleBox(orbit.camera)
      .map((share) => share.toFixed(3))
      .join(" "); // for the tests
  };
  let before = performance.now();
  everyFrame((now, painted) => {
    const elapsed = Math.min(100, now - before);
    before = now;
    const source = app.source.value;
    const scene = source.scene.value;
    if (!scene || stage.lost) return;
    if (scene !== built) build(scene);
    if (framing.free.value) orbit.enclose(world.outline(), framing.free.value);
    let turned = orbit.step(elapsed);
    const ghost = source.live ? hand.target.value : poseBeside(source, app.overlay.value, source.shown() ?? 0);
    const pixel = orbit.mmPerPixel(world.moment.tip, stage.height);
    const changed = world.update(source, ghost, orbit.camera, pixel);
    if (!placed && world.moment.tick >= 0) {
      placed = true;
      settle();
      turned = orbit.step(0);
    }
    drawRing(source, scene, orbit.camera, stage.width, stage.height, (framing.free.value?.right ?? 1) * stage.width);
    canvas.dataset.time = source.live ? "" : world.moment.time.toFixed(4); // for the end-to-end tests
    if (turned && world.extent) world.placeArrow(orbit.camera, world.extent, scene);
    if (framing.free.value && (turned || changed || stage.stale)) tellStage();
    const framed = sliceFrame.update(scene, probe);
    if (!turned && !changed && !framed && !stage.stale) {
      stage.rest(orbit.camera, now, painted);
      return;
    }
    showHub(world.hiddenHub(orbit.camera, covered / Math.max(1, stage.height)));
    stage.draw(orbit.camera, now, painted, turned || framed || stage.stale || !world.still);
    world.name(orbit.camera);
    drawScale(pixel);
    speak(world.moment, scene, now);
  });
};

/** Replaces the view if the browser has no WebGL: speaks the needle's state to a screen reader. */
function followInWords(app: App, speak: (moment: Moment, scene: SceneView, now: number) => void): void {
  const moment = new Moment();
  everyFrame((now) => {
    const source = app.source.value;
    const scene = source.scene.value;
    if (scene && source.history.membranes === scene.membranes.length && moment.read(source)) speak(moment, scene, now);
  });
}
