import { element, type Panel } from "../panel.ts";

const STAY_MS = 9000;
const MOST = 4;

/** Sentences for the person: they come, are read out, and go by themselves or by a click. */
export const notices: Panel = (host, app) => {
  const region = element("div", { class: "toasts", "aria-live": "polite", role: "log" });
  host.append(region);
  let known = app.notices.value;
  app.notices.watch((list) => {
    if (list === known) return;
    known = list;
    const text = list[0];
    if (text === undefined) return;
    for (const toast of [...region.children]) if (toast.firstChild?.textContent === text) toast.remove();
    const toast = element("div", { class: "toast" }, element("span", {}, text));
    const gone = (): void => toast.remove();
    let timer = setTimeout(gone, STAY_MS);
    // Whoever reads it keeps it.
    toast.addEventListener("pointerenter", () => clearTimeout(timer));
    toast.addEventListener("pointerleave", () => {
      timer = setTimeout(gone, STAY_MS / 3);
    });
    toast.append(
      element(
        "button",
        { type: "button", class: "quiet-button", "aria-label": "Away with this message", onclick: gone },
        "×",
      ),
    );
    region.append(toast);
    while (region.children.length > MOST) region.firstElementChild?.remove();
  });
};
