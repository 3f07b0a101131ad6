import { element, type Panel } from "../panel.ts";

const STAY_MS = 9000;
const MOST = 4;

/** Messages for the user. They are read out, and disappear after a while or by a click. */
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
    // It stays while the pointer is over it.
    toast.addEventListener("pointerenter", () => clearTimeout(timer));
    toast.addEventListener("pointerleave", () => {
      timer = setTimeout(gone, STAY_MS / 3);
    });
    toast.append(
      element(
        "button",
        { type: "button", class: "quiet-button", "aria-label": "Close this message", onclick: gone },
        "×",
      ),
    );
    region.append(toast);
    while (region.children.length > MOST) region.firstElementChild?.remove();
  });
};
