import { element, keptList, type Panel } from "../panel.ts";
import type { App } from "../state/app.ts";
import { pageOf, show } from "../state/page.ts";
import { keep, storage } from "../state/remembered.ts";
import type { Choice } from "../wire/messages.ts";
import { arrangementsOf } from "./arrange/arrange.ts";
import { menu } from "./arrange/menu.ts";
import { controlLine } from "./control_line.ts";
import { stateButton } from "./state_button.ts";
import { startTour } from "./tour.ts";
import { connectionWords } from "./words.ts";

const toTabs = (): void => {
  const tab = document.querySelector<HTMLElement>(".side [role=tab][aria-selected=true]");
  tab?.scrollIntoView({ block: "nearest" });
  tab?.focus();
};

/** The header: scene, device, state of the force, control and connection. */
export const headerBar: Panel = (host, app) => {
  const device = element("span", { class: "device" });
  app.hello.watch((hello) => {
    const info = hello?.device;
    const second = hello?.second_device ? `; thumb on ${hello.second_device}` : "";
    device.textContent = info ? info.model : "";
    device.title = info ? `${info.backend}, at most ${info.max_force} N, ${info.rate} Hz${second}` : "";
  });
  host.append(
    // Past the view and the plots, which have most of the page's tab stops.
    element("button", { type: "button", class: "skip-link", onclick: toTabs }, "Go to the tabs"),
    element(
      "h1",
      { class: "brand" },
      element("img", { src: "./icon.svg", alt: "", width: 20, height: 20 }),
      "Punctura",
    ),
    scenePicker(app),
    device,
    element("span", { class: "gap" }),
    stateButton(app),
    element("span", { class: "gap" }),
    controlLine(app),
    connectionLine(app),
    element(
      "button",
      {
        type: "button",
        class: "quiet-button",
        title: "The tissue, one force and one curve (Alt+B)",
        onclick: () => show(pageOf(app), "stage"),
      },
      "Stage",
    ),
    layoutMenu(app),
    element(
      "button",
      { type: "button", class: "quiet-button", title: "Four things to do with the needle", onclick: startTour },
      "Tour",
    ),
    themeSwitch(),
  );
};

const KEY = "punctura.theme";
const CHOICES = [
  ["light dark", "◐", "system"],
  ["light", "☀", "light"],
  ["dark", "☾", "dark"],
] as const;

/** Switches between light, dark and the system's colours. The choice is stored in this browser. */
function themeSwitch(): HTMLElement {
  let index = Math.max(
    0,
    CHOICES.findIndex(([scheme]) => scheme === storage()?.getItem(KEY)),
  );
  const button = element("button", { type: "button", class: "quiet-button" });
  const show = (): void => {
    const [scheme, mark, words] = CHOICES[index]!;
    if (scheme === "light dark") document.documentElement.style.removeProperty("color-scheme");
    else document.documentElement.style.colorScheme = scheme;
    button.textContent = mark;
    button.title = `Colours: ${words}`;
    button.setAttribute("aria-label", button.title);
  };
  button.addEventListener("click", () => {
    index = (index + 1) % CHOICES.length;
    keep(KEY, CHOICES[index]![0]);
    show();
  });
  show();
  return button;
}

const OWN = "";

/** The list of ready scenes. A scene from a file, or an edited one, comes first. */
function scenePicker(app: App): HTMLElement {
  const select = element("select", { "aria-label": "Scene", class: "scene-picker" });
  const offer = keptList<Choice>(select, ({ name, title }) => element("option", { value: name }, title));
  const show = (): void => {
    const hello = app.hello.value;
    const scene = app.live.scene.value;
    if (!hello) return;
    const ready = hello.scenes.find(({ name, title }) => title === scene?.name || name === scene?.name);
    offer([...(scene && !ready ? [{ name: OWN, title: scene.name }] : []), ...hello.scenes]);
    select.value = ready?.name ?? OWN;
  };
  app.hello.watch(show);
  app.live.scene.watch(show);
  let loading = false;
  const enable = (): void => {
    select.disabled = loading || !app.control.value.you || app.connection.value.state !== "open";
  };
  app.control.watch(enable);
  app.connection.watch(enable);
  select.addEventListener("change", () => {
    if (select.value === OWN) return;
    loading = true;
    enable();
    void app.ask({ do: "load", scene: select.value }).then((reply) => {
      loading = false;
      enable();
      if (!reply?.ok) show();
    });
  });
  return select;
}

const SILENT_MS = 2000;
const LOOK_MS = 250;

/** A line with the state of the connection. It also tells if the studio is connected but sends no ticks. */
function connectionLine(app: App): HTMLElement {
  const dot = element("span", { class: "dot", "aria-hidden": "true" });
  // The countdown is only visible; a screen reader gets the changes of state.
  const words = element("span", { class: "connection-words", "aria-hidden": "true" });
  const spoken = element("span", { class: "only-read", role: "status" });
  const line = element("span", { class: "connection" }, dot, words, spoken);
  let since = performance.now();
  let end = -1;
  let lastTick = performance.now();
  const show = (): void => {
    const now = app.connection.value;
    const { history } = app.live;
    if (history.end !== end) {
      end = history.end;
      lastTick = performance.now();
    }
    const silent = now.state === "open" && performance.now() - Math.max(lastTick, since) > SILENT_MS;
    const left = now.state === "lost" ? now.retryInMs - (performance.now() - since) : 0;
    const text = connectionWords(now, silent, left, app.engine.studio);
    if (words.textContent !== text) words.textContent = text;
    const state = now.state === "lost" ? "No connection; retrying" : text;
    const steady = now.state === "connecting" && now.attempt > 1 ? spoken.textContent : state;
    if (spoken.textContent !== steady) spoken.textContent = steady;
    line.dataset.state = silent ? "lost" : now.state;
    line.title = now.state === "lost" ? now.reason : "";
  };
  app.connection.watch(() => {
    since = performance.now();
    show();
  });
  setInterval(show, LOOK_MS);
  return line;
}

/** The menu Layout of the header. */
function layoutMenu(app: App): HTMLElement {
  const all = arrangementsOf(app);
  return menu("Layout", "Layout", () => {
    const { projector } = all.now.value;
    return [
      [
        projector ? "All panels" : "Projector: view and one plot, large",
        () => all.set({ projector: !projector }),
        "Alt+P",
      ],
      ["Default layout", () => all.reset()],
    ];
  });
}
