import { element, everyFrame, type Panel } from "../panel.ts";

/** Says in the view that it shows the moment under a plot's cursor. The plots read the values out. */
export const momentLine: Panel = (host, app) => {
  const line = element("p", { class: "view-moment", "aria-hidden": "true", hidden: true });
  host.append(line);
  let shown: number | null = null;
  everyFrame(() => {
    const { pointed, history } = app.source.value;
    if (pointed.value === shown) return;
    shown = pointed.value;
    line.hidden = shown === null;
    if (shown !== null) line.textContent = `under the cursor: ${history.timeOf(shown).toFixed(3)} s`;
  });
};
