import { element } from "../panel.ts";
import { keep, storage } from "../state/storage.ts";

const KEY = "punctura.theme";
const CHOICES = [
  ["light dark", "◐", "system"],
  ["light", "☀", "light"],
  ["dark", "☾", "dark"],
] as const;

/** Switches between light, dark and the system's colours. The choice is stored in this browser. */
export function themeSwitch(): HTMLElement {
  let index = Math.max(
    0,
    CHOICES.findIndex(([scheme]) => scheme === storage()?.getItem(KEY)),
  );
  const button = element("button", { type: "button", class: "quiet-button" });
  const show = (): void => {
    const [scheme, mark, words] = CHOICES[index]!;
    if (scheme === "light dark") document.documentElement.style.removeProperty("color-scheme");
    else document.documentElement.style.colorScheme = scheme;
    button.textContent = mark;
    button.title = `Colours: ${words}`;
    button.setAttribute("aria-label", button.title);
  };
  button.addEventListener("click", () => {
    index = (index + 1) % CHOICES.length;
    keep(KEY, CHOICES[index]![0]);
    show();
  });
  show();
  return button;
}
