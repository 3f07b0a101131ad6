import { newton } from "../../format.ts";
import { element } from "../../panel.ts";
import type { App } from "../../state/app.ts";
import type { Estimated, EstimateMessage } from "../../wire/messages.ts";

const PHASES: Readonly<Record<EstimateMessage["phase"], string>> = {
  free: "no membrane in contact",
  rise: "a membrane in contact",
  behind: "behind a puncture",
};

export const slopeWords = (now: Estimated | null): string =>
  now ? `${(now.value / 1e3).toFixed(3)} ± ${(now.half / 1e3).toFixed(3)} N/mm` : "–";
export const plateauWords = (now: Estimated | null): string =>
  now ? `${now.value.toFixed(3)} ± ${newton(now.half, 3)}` : "–";

/** "Estimate while it runs": what depth and force alone tell of the run. */
export function estimatePart(app: App): HTMLElement {
  const on = element("input", { type: "checkbox", id: "live-estimate" });
  let asking = false;
  on.addEventListener("change", async () => {
    asking = true;
    const reply = await app.ask({ do: "estimate", on: on.checked });
    if (!reply?.ok) on.checked = !on.checked;
    asking = false;
  });
  const lines = ["Now", "Slope of the force", "Friction behind the puncture", "Punctures found", "Last drop"].map(
    (name) => {
      const value = element("dd", {}, "–");
      return { name, value };
    },
  );
  const list = element(
    "dl",
    { class: "estimate", hidden: true },
    ...lines.flatMap(({ name, value }) => [element("dt", {}, name), value]),
  );
  const show = (now: EstimateMessage | null): void => {
    if (!asking) on.checked = now !== null;
    list.hidden = now === null || app.blind;
    if (!now) return;
    const words = [
      PHASES[now.phase],
      slopeWords(now.slope),
      plateauWords(now.plateau),
      String(now.punctures) + (now.ignored > 0 ? ` (${now.ignored} samples left out)` : ""),
      now.punctures > 0 ? newton(now.drop, 3) : "–",
    ];
    lines.forEach(({ value }, i) => {
      value.textContent = words[i]!;
    });
  };
  app.estimate.watch(show);
  app.exercise.watch(() => show(app.estimate.value));
  return element(
    "section",
    {},
    element("h3", {}, "Estimate while it runs"),
    element(
      "p",
      { class: "quiet" },
      "From depth and model force alone, without the scene: ± is a 95 % interval for noise, not for a curved force. " +
        "Punctures are marked in the plot against time.",
    ),
    element("label", { class: "check" }, on, "Estimate"),
    list,
  );
}
