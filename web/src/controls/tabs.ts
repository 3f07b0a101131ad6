import { element, type Panel } from "../panel.ts";
import type { App } from "../state/app.ts";

/** Calls `open` when a tab shall open by itself. */
export type Opens = (app: App, open: () => void) => void;

/** Tabs that show one panel at a time, by the tab pattern of WAI-ARIA: arrow keys switch the tab. */
export function tabs(entries: ReadonlyArray<readonly [id: string, label: string, panel: Panel, opens?: Opens]>): Panel {
  return (host, app) => {
    const list = element("div", { role: "tablist", class: "tabs" });
    const buttons: HTMLButtonElement[] = [];
    const bodies: HTMLElement[] = [];
    const choose = (index: number, focus: boolean): void => {
      buttons.forEach((button, i) => {
        button.setAttribute("aria-selected", String(i === index));
        button.tabIndex = i === index ? 0 : -1;
        bodies[i]!.hidden = i !== index;
      });
      if (focus) buttons[index]!.focus();
    };
    entries.forEach(([id, label, panel], index) => {
      const button = element(
        "button",
        {
          role: "tab",
          id: `tab-${id}`,
          "aria-controls": `panel-${id}`,
          type: "button",
          onclick: () => choose(index, false),
        },
        label,
      );
      button.addEventListener("keydown", (event) => {
        const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
        if (step) choose((index + step + entries.length) % entries.length, true);
      });
      const body = element("div", {
        role: "tabpanel",
        id: `panel-${id}`,
        "aria-labelledby": `tab-${id}`,
        class: `tab ${id}`,
      });
      buttons.push(button);
      bodies.push(body);
      list.append(button);
      panel(body, app);
    });
    host.append(list, ...bodies);
    choose(0, false);
    entries.forEach(([, , , opens], index) => {
      opens?.(app, () => choose(index, false));
    });
  };
}
