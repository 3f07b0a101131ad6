import { element, type Panel } from "../panel.ts";

/** The banner of a fault: its reason, and the Reset button. */
export const faultBanner: Panel = (host, app) => {
  host.setAttribute("role", "alert");
  const show = (): void => {
    const fault = app.fault.value;
    if (!fault) {
      host.replaceChildren();
      return;
    }
    const more = [
      fault.trouble,
      fault.tick === null ? "" : `Tick ${fault.tick}; the ${fault.kept} ticks before it are saved.`,
    ];
    const reset = element(
      "button",
      { type: "button", class: "button danger", onclick: () => void app.ask({ do: "reset" }) },
      "Reset",
    );
    reset.disabled = !app.control.value.you;
    if (reset.disabled) reset.title = "Another page has control";
    host.replaceChildren(
      element("span", { class: "fault-mark", "aria-hidden": "true" }, "▲"),
      element(
        "div",
        { class: "fault-words" },
        element("strong", {}, `Fault, no force: ${fault.reason}`),
        element("span", { class: "fault-more" }, more.filter(Boolean).join(" ")),
      ),
      reset,
    );
  };
  app.fault.watch(show);
  app.control.watch(show);
};
