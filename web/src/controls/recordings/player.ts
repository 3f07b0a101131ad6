import { button, element, everyFrame, type Panel } from "../../panel.ts";
import type { App } from "../../state/app.ts";
import type { Source } from "../../state/source.ts";
import { Playback } from "./playback.ts";
import { showingOf } from "./showing.ts";
import { eventText } from "./words.ts";

const REST_MS = 1500; // after the end of an excerpt, before the page goes back by itself

/** The replay bar: name, scrubber and the way back. Hidden while the live run is shown. */
export const playerBar: Panel = (host, app) => {
  host.hidden = true;
  let close = (): void => {};
  let before: Source | null = null;
  app.source.watch((source) => {
    close();
    // A pause begins at the present moment; back from an excerpt, a recording goes on where it was.
    const from = source.paused || before?.excerpt?.of === source ? source.cursor.value : null;
    before = source;
    close = (): void => {};
    host.replaceChildren();
    host.hidden = source.live;
    host.dataset.of = source.excerpt ? "excerpt" : source.paused ? "pause" : "recording";
    document.documentElement.classList.toggle("replaying", !source.live);
    const scene = source.scene.value; // a recording has one from the start
    if (!source.live && scene) close = fill(host, app, source, scene.rate, from);
  });
};

/** rate: ticks per second. from: the tick to begin at; null: the first, and it plays. */
function fill(host: HTMLElement, app: App, source: Source, rate: number, from: number | null): () => void {
  const showing = showingOf(app, source);
  const playback = new Playback(showing.first, showing.last, rate);
  playback.speed = showing.speed;
  let used = false; // whether the user has used the bar
  let rested = 0; // ms since the end

  const step: typeof button = (...words) => Object.assign(button(...words), { className: "small step" });
  const play = button("▶", "Play (space)", () => {
    used = true;
    if (playback.playing) playback.pause();
    else playback.play();
    show();
  });
  const go = (tick: number | null): void => {
    if (tick === null) return;
    used = true;
    playback.pause();
    playback.seek(tick);
    show();
  };
  const stepped = (ticks: number) => (): void => go(playback.tick + ticks);
  const events = (): number[] =>
    source.events.value.map(({ tick }) => tick).filter((tick) => tick >= playback.first && tick <= playback.last);
  const track = element("input", {
    type: "range",
    min: playback.first,
    max: playback.last,
    step: 1,
    "aria-label": "Time in the recording; arrow keys move by one tick",
  });
  track.addEventListener("input", () => go(Number(track.value)));
  const marks = element("div", { class: "marks", "aria-hidden": "true" });
  const time = element("output", { class: "time" });
  const speed = element("select", { "aria-label": "Speed" });
  for (const [each, words] of showing.speeds)
    speed.append(element("option", { value: each, selected: Math.abs(each - showing.speed) < 1e-9 }, words));
  speed.addEventListener("change", () => {
    showing.speed = Number(speed.value);
    playback.speed = showing.speed;
    if (showing.goesBack && playback.atEnd) playback.play();
  });

  const show = (): void => {
    source.cursor.value = playback.tick;
    track.value = String(playback.tick);
    track.setAttribute("aria-valuetext", showing.spokenTime(playback.tick));
    time.textContent = showing.time(playback.tick);
    play.textContent = playback.playing ? "❚❚" : "▶";
    const words = playback.playing ? "Pause (space)" : "Play (space)";
    if (play.title !== words) {
      play.title = words;
      play.setAttribute("aria-label", words);
    }
  };
  const span = Math.max(playback.last - playback.first, 1);
  for (const event of source.events.value) {
    if (event.tick < playback.first || event.tick > playback.last) continue;
    const mark = element("i", { class: `mark ${event.what}`, title: eventText(event) });
    mark.style.setProperty("--at", String((event.tick - playback.first) / span));
    marks.append(mark);
  }
  host.append(
    element(
      "div",
      { class: "banner", role: "status" },
      element("span", { class: "quiet" }, showing.kind),
      " ",
      element("strong", { title: source.title }, source.title),
    ),
    element(
      "div",
      { class: "transport", role: "group", "aria-label": "Replay" },
      step("⇤", "Previous event", () => go(playback.neighbour(events(), -1))),
      step("‹", "Back one tick (left arrow)", stepped(-1)),
      play,
      step("›", "Forward one tick (right arrow)", stepped(1)),
      step("⇥", "Next event", () => go(playback.neighbour(events(), 1))),
    ),
    element("div", { class: "track" }, marks, track),
    time,
    speed,
    button(showing.backWords, showing.backTitle, () => showing.back(), "small primary"),
  );
  const keys = (event: KeyboardEvent): void => {
    if (event.target instanceof HTMLSelectElement) return;
    const act = { " ": () => play.click(), ArrowLeft: stepped(-1), ArrowRight: stepped(1) }[event.key];
    if (!act || (event.key === " " && event.target instanceof HTMLButtonElement)) return;
    event.preventDefault();
    act();
  };
  host.addEventListener("keydown", keys);
  // A plot can move the cursor too; the scrubber follows it.
  const unwatch = source.cursor.watch((tick) => {
    if (tick !== null && tick !== playback.tick) go(tick);
  });
  if (from !== null) playback.seek(from);
  else if (!matchMedia("(prefers-reduced-motion: reduce)").matches) playback.play();
  show();
  let last: number | null = null;
  const stop = everyFrame((now) => {
    const seconds = last === null ? 0 : Math.min((now - last) / 1e3, 0.25);
    last = now;
    const wasPlaying = playback.playing;
    if (playback.advance(seconds) || wasPlaying !== playback.playing) show();
    rested = playback.atEnd && !playback.playing ? rested + 1e3 * seconds : 0;
    if (showing.goesBack && !used && rested > REST_MS) showing.back();
  });
  return () => {
    stop();
    unwatch();
    host.removeEventListener("keydown", keys);
  };
}
