import { Color } from "three";
import { colourToken } from "../state/colours.ts";

/** The present colours of styles/tokens.css. */
export class Theme {
  dark = false;
  private readonly probe: HTMLElement;
  private readonly known = new Map<string, Color>();
  private readonly listeners = new Set<() => void>();

  constructor() {
    this.probe = document.createElement("span");
    this.probe.hidden = true;
    document.body.append(this.probe); // not to the panel, which is added to the page later
    this.read();
    const again = (): void => {
      this.read();
      for (const listener of this.listeners) listener();
    };
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", again);
    new MutationObserver(again).observe(document.documentElement, {
      attributes: true,
      attributeFilter: ["style", "class"],
    });
  }

  /** The colour of a token, such as "data-1". */
  color(token: string): Color {
    let color = this.known.get(token);
    if (!color) {
      this.probe.style.color = `var(--${token})`;
      color = new Color(getComputedStyle(this.probe).color);
      this.known.set(token, color);
    }
    return color;
  }

  /** The colour of a membrane, as in the plots. */
  membrane(index: number): Color {
    return this.color(colourToken(index));
  }

  watch(listener: () => void): void {
    this.listeners.add(listener);
    listener();
  }

  private read(): void {
    this.known.clear();
    const text = this.color("text");
    this.dark = text.r + text.g + text.b > 1.5;
  }
}
