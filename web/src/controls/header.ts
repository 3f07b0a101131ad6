import { element, type Panel } from "../panel.ts";
import { pageOf, show } from "../state/page.ts";
import { layoutMenu } from "./arrange/layout_menu.ts";
import { connectionLine } from "./connection_line.ts";
import { controlLine } from "./control_line.ts";
import { scenePicker } from "./scene_picker.ts";
import { stateButton } from "./state_button.ts";
import { themeSwitch } from "./theme_switch.ts";
import { startTour } from "./tour.ts";

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
