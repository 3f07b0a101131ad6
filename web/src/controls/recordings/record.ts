import { errorText } from "../../format.ts";
import { element } from "../../panel.ts";
import type { App } from "../../state/app.ts";
import { blockOf, watchBlock } from "../blocked.ts";
import { words } from "../editor/problems.ts";
import { countText } from "./words.ts";

/** The buttons Record and Stop, and the state of the recording. */
export function recordControl(app: App): HTMLElement {
  const name = element("input", {
    type: "text",
    class: "words",
    maxlength: 80,
    placeholder: "Name, or date and time",
    "aria-label": "Name of the recording; the default is date and time",
    "aria-describedby": "record-error",
    autocomplete: "off",
  });
  const error = element("p", { class: "error", id: "record-error", role: "alert" });
  const button = element("button", { type: "submit", class: "small record" }, "Record");
  const current = element("strong", { class: "record-name" });
  const form = element("form", { class: "record-row" }, current, name, button);
  const line = element("p", { class: "quiet record-line" });
  let recording = false;

  form.addEventListener("submit", async (event) => {
    event.preventDefault();
    button.disabled = true;
    error.textContent = "";
    name.removeAttribute("aria-invalid");
    const wish = name.value.trim();
    const stops = recording;
    // A refusal is shown at the field, not as a message of the page.
    const refusal = await app.engine
      .ask(stops ? { do: "stop_recording" } : { do: "start_recording", ...(wish ? { name: wish } : {}) })
      .then((reply) => (reply.ok ? "" : reply.text || "the request was refused"))
      .catch(errorText);
    button.disabled = blockOf(app, "scene") !== null;
    if (refusal) {
      error.textContent = words(refusal);
      if (!stops) name.setAttribute("aria-invalid", "true");
    } else if (!stops) name.value = ""; // during a stop, a person may type the next name already
  });
  app.recording.watch((now) => {
    recording = now !== null;
    button.textContent = recording ? "Stop" : "Record";
    button.classList.toggle("on", recording);
    name.hidden = recording;
    current.hidden = now === null;
    current.textContent = now?.name ?? "";
    line.classList.toggle("on", recording);
    const trouble = now?.trouble ? `. ${now.trouble}` : "";
    line.textContent = now
      ? `${now.seconds.toFixed(1)} s, ${countText(now.rows)} ticks, ${countText(now.lost)} lost${trouble}`
      : "Starts a new run. Force returns once the tip is outside tissue.";
  });
  watchBlock(
    app,
    (block) => {
      button.disabled = block !== null;
      name.disabled = block !== null;
    },
    "scene",
  );
  return element("div", { class: "record-part" }, form, line, error);
}
