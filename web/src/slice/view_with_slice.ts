import { element, type Panel } from "../panel.ts";
import { probeOf } from "../scene/probe.ts";
import { view } from "../scene/view.ts";
import { remember, wasOpen } from "./remembered.ts";
import { slice } from "./slice.ts";

/** The 3-D view, and beside it the slice, which a button in the view's toolbar opens and closes. */
export const viewWithSlice: Panel = (host, app) => {
  const main = element("div", { class: "view-main" });
  const beside = element("section", { class: "slice", id: "slice", "aria-label": "Slice", hidden: true });
  host.append(main, beside);
  const probe = probeOf(app);
  view(main, app);
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
    slice(beside, app, probe, close);
  };
  button.addEventListener("click", () => {
    show(!open);
    remember(open);
  });
  (main.querySelector(".view-tools") ?? main).append(button);
  show(wasOpen());
};
