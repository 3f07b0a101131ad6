import { element, everyFrame, type Panel } from "../../panel.ts";
import type { App } from "../../state/app.ts";
import type { Source } from "../../state/source.ts";
import { Playback, SPEEDS } from "./playback.ts";
import { eventText } from "./words.ts";

/** The replay bar: name, scrubber and Back to live. Hidden while the live run is shown. */
export const playerBar: Panel = (host, app) => {
  host.hidden = true;
  let close = (): void => {};
  app.source.watch((source) => {
    close();
    close = (): void => {};
    host.replaceChildren();
    host.hidden = source.live;
    document.documentElement.classList.toggle("replaying", !source.live);
    if (!source.live) close = fill(host, app, source);
  });
};

function fill(host: HTMLElement, app: App, source: Source): () => void {
  const { history } = source;
  const playback = new Playback(
    history.first,
    Math.max(history.end - 1, history.first),
    source.scene.value?.rate ?? 1600,
  );
  const start = history.timeOf(history.first);
  const total = (history.timeOf(history.end - 1) - start).toFixed(3);

  const button = (label: string, words: string, act: () => void): HTMLButtonElement =>
    element("button", { type: "button", class: "small", title: words, "aria-label": words, onclick: act }, label);
  const play = button("▶", "Play (space)", () => {
    if (playback.playing) playback.pause();
    else playback.play();
    show();
  });
  const go = (tick: number | null): void => {
    if (tick === null) return;
    playback.pause();
    playback.seek(tick);
    show();
  };
  const stepped = (ticks: number) => (): void => go(playback.tick + ticks);
  const events = (): number[] => source.events.value.map(({ tick }) => tick);
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
  for (const each of SPEEDS) speed.append(element("option", { value: each, selected: each === 1 }, `${each}×`));
  speed.addEventListener("change", () => {
    playback.speed = Number(speed.value);
  });

  const show = (): void => {
    const now = history.timeOf(playback.tick) - start;
    source.cursor.value = playback.tick;
    track.value = String(playback.tick);
    track.setAttribute("aria-valuetext", `${now.toFixed(3)} of ${total} seconds`);
    time.textContent = `${now.toFixed(3).padStart(total.length, " ")} / ${total} s`;
    play.textContent = playback.playing ? "❚❚" : "▶";
    const words = playback.playing ? "Pause (space)" : "Play (space)";
    if (play.title !== words) {
      play.title = words;
      play.setAttribute("aria-label", words);
    }
  };
  const span = Math.max(playback.last - playback.first, 1);
  for (const event of source.events.value) {
    const mark = element("i", { class: `mark ${event.what}`, title: eventText(event) });
    mark.style.setProperty("--at", String((event.tick - playback.first) / span));
    marks.append(mark);
  }
  host.append(
    element(
      "div",
      { class: "banner", role: "status" },
      element("span", { class: "quiet" }, "Replay of"),
      " ",
      element("strong", { title: source.title }, source.title),
    ),
    element(
      "div",
      { class: "transport", role: "group", "aria-label": "Replay" },
      button("⇤", "Previous event", () => go(playback.neighbour(events(), -1))),
      button("‹", "Back one tick (left arrow)", stepped(-1)),
      play,
      button("›", "Forward one tick (right arrow)", stepped(1)),
      button("⇥", "Next event", () => go(playback.neighbour(events(), 1))),
    ),
    element("div", { class: "track" }, marks, track),
    time,
    speed,
    element(
      "button",
      {
        type: "button",
        class: "small primary",
        onclick: () => {
          app.source.value = app.live;
        },
      },
      "Back to live",
    ),
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
  if (!matchMedia("(prefers-reduced-motion: reduce)").matches) playback.play();
  show();
  let last: number | null = null;
  const stop = everyFrame((now) => {
    const seconds = last === null ? 0 : Math.min((now - last) / 1e3, 0.25);
    last = now;
    const wasPlaying = playback.playing;
    if (playback.advance(seconds) || wasPlaying !== playback.playing) show();
  });
  return () => {
    stop();
    unwatch();
    host.removeEventListener("keydown", keys);
  };
}
