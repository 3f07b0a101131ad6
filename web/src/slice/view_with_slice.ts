import { element, type Panel } from "../panel.ts";
import { probeOf } from "../scene/probe.ts";
import { view } from "../scene/view.ts";
import { pageOf } from "../state/page.ts";
import { keep, storage } from "../state/remembered.ts";

/**
 * The 3-D view, and beside it the slice, which a button in the view's toolbar opens and closes. Without WebGL, the
 * slice is what the stage shows.
 */
export const viewWithSlice: Panel = (host, app) => {
  const main = element("div", { class: "view-main" });
  const beside = element("section", { class: "slice", id: "slice", "aria-label": "Slice", hidden: true });
  host.append(main, beside);
  const probe = probeOf(app);
  view(main, app);
  const page = pageOf(app);
  const flat = main.querySelector("canvas")?.hidden === true;
  const button = element(
    "button",
    { type: "button", title: "A slice through the tissue, drawn like an ultrasound picture", "aria-controls": "slice" },
    "Slice",
  );
  let open = false;
  let started = false;
  const show = (wanted: boolean): void => {
    open = wanted;
    beside.hidden = !open;
    host.classList.toggle("with-slice", open);
    button.setAttribute("aria-pressed", String(open));
    if (!open) probe.picture.value = null;
    if (!open || started) return;
    started = true;
    const close = (): void => {
      show(false);
      remember(false);
      button.focus();
    };
    void import("./slice.ts").then(
      ({ slice }) => slice(beside, app, probe, close, () => flat && page.value === "stage"),
      () => {
        started = false;
        app.notify("The slice could not be loaded.");
      },
    );
  };
  button.addEventListener("click", () => {
    show(!open);
    remember(open);
  });
  (main.querySelector(".view-tools") ?? main).append(button);
  page.watch((now) => show(now === "stage" ? flat : wasOpen()));
};

const KEY = "punctura.slice";

/** Whether the slice is open, as this browser remembers it. If it may not, the slice is closed at first. */
function wasOpen(): boolean {
  return storage()?.getItem(KEY) === "open";
}

function remember(open: boolean): void {
  keep(KEY, open ? "open" : "closed");
}
