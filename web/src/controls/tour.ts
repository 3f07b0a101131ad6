import { element, type Panel } from "../panel.ts";
import { storage } from "./exercises/person.ts";
import { placed } from "./tour/placing.ts";
import { STEPS } from "./tour/steps.ts";

const KEY = "punctura.tour";

let begin: () => void = () => {};

/** Starts the tour from its first step, even if it was seen before. */
export const startTour = (): void => begin();

/** Four popovers next to the parts that they explain. The page works as usual meanwhile; Escape ends the tour. */
export const tour: Panel = (root, app) => {
  let end: () => void = () => {};
  begin = () => {
    end();
    end = show(root, () => storage()?.setItem(KEY, "seen"));
  };
  if (storage()?.getItem(KEY)) return;
  // It starts with the first scene, when there is something to see.
  const stop = app.live.scene.watch((scene) => {
    if (!scene) return;
    setTimeout(() => {
      stop();
      begin();
    });
  });
};

function show(root: HTMLElement, seen: () => void): () => void {
  let at = 0;
  const before = document.activeElement;
  const title = element("h2", { id: "tour-title" });
  const text = element("p", { id: "tour-text" });
  const count = element("span", { class: "count" });
  const button = (label: string, act: () => void, kind = ""): HTMLButtonElement =>
    element("button", { type: "button", class: kind, onclick: act }, label);
  const back = button("Back", () => go(at - 1));
  const next = button("Next", () => (at === STEPS.length - 1 ? close() : go(at + 1)), "primary");
  const skip = button("Skip", () => close());
  const box = element(
    "div",
    { class: "tour", role: "dialog", "aria-labelledby": "tour-title", "aria-describedby": "tour-text" },
    title,
    text,
    element("div", { class: "row" }, count, skip, back, next),
  );

  const place = (): void => {
    const target = targetOf(root, at);
    root.querySelectorAll(".toured").forEach((each) => {
      if (each !== target) each.classList.remove("toured");
    });
    target?.classList.add("toured");
    const to = target?.getBoundingClientRect() ?? new DOMRect(innerWidth / 2, innerHeight / 2, 0, 0);
    const { left, top, side } = placed(
      to,
      { width: box.offsetWidth, height: box.offsetHeight },
      { width: innerWidth, height: innerHeight },
    );
    box.style.left = `${left}px`;
    box.style.top = `${top}px`;
    box.dataset.side = side;
  };
  const go = (to: number): void => {
    at = Math.min(Math.max(to, 0), STEPS.length - 1);
    const step = STEPS[at]!;
    title.textContent = step.title;
    text.textContent = step.text;
    count.textContent = `${at + 1} of ${STEPS.length}`;
    back.disabled = at === 0;
    next.textContent = at === STEPS.length - 1 ? "Done" : "Next";
    skip.hidden = at === STEPS.length - 1;
    if (step.tab) root.querySelector<HTMLElement>(`#tab-${step.tab}`)?.click();
    targetOf(root, at)?.scrollIntoView({ block: "nearest" });
    place();
  };
  const close = (): void => {
    seen();
    window.removeEventListener("resize", place);
    window.removeEventListener("scroll", place, true);
    document.removeEventListener("keydown", keys);
    root.querySelector(".toured")?.classList.remove("toured");
    const hadFocus = box.contains(document.activeElement);
    box.remove();
    if (hadFocus && before instanceof HTMLElement) before.focus();
  };
  const keys = (event: KeyboardEvent): void => {
    if (event.key === "Escape" && !document.querySelector("dialog[open]")) close();
  };
  window.addEventListener("resize", place);
  window.addEventListener("scroll", place, true);
  document.addEventListener("keydown", keys);
  root.prepend(box); // first in the order of the tab key
  go(0);
  return close;
}

function targetOf(root: HTMLElement, at: number): HTMLElement | null {
  for (const selector of STEPS[at]?.at ?? []) {
    const found = root.querySelector<HTMLElement>(selector);
    if (found && found.offsetParent !== null) return found;
  }
  return null;
}
