import { COLOURS, colourToken } from "../../state/colours.ts";

/** The colours of styles/tokens.css, resolved for use on a canvas. */
export interface Theme {
  readonly panel: string;
  readonly line: string;
  readonly text: string;
  readonly quiet: string;
  readonly accent: string;
  readonly danger: string;
  /** Colours of the membranes, repeated in turn. */
  readonly data: readonly string[];
}

const DATA = Array.from({ length: COLOURS }, (_, membrane) => `--${colourToken(membrane)}`);

/** The colours by their names: for SVG inside the page, which follows the page's theme by itself. */
export const CSS_THEME: Theme = {
  panel: "var(--panel)",
  line: "var(--line)",
  text: "var(--text)",
  quiet: "var(--quiet)",
  accent: "var(--accent)",
  danger: "var(--danger)",
  data: DATA.map((name) => `var(${name})`),
};

/** Calls `changed` with the present colours, and again whenever the page turns light or dark. */
export function watchTheme(changed: (theme: Theme) => void): void {
  const probe = document.createElement("i");
  probe.hidden = true;
  document.body.append(probe);
  // getPropertyValue would return the text light-dark(...); the computed colour of an element is resolved.
  const read = (colour: string): string => {
    probe.style.color = colour;
    return getComputedStyle(probe).color;
  };
  const notify = (): void =>
    changed({
      panel: read(CSS_THEME.panel),
      line: read(CSS_THEME.line),
      text: read(CSS_THEME.text),
      quiet: read(CSS_THEME.quiet),
      accent: read(CSS_THEME.accent),
      danger: read(CSS_THEME.danger),
      data: CSS_THEME.data.map(read),
    });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", notify);
  new MutationObserver(notify).observe(document.documentElement, { attributes: true });
  notify();
}

export const colourOf = (theme: Theme, membrane: number): string => theme.data[membrane % theme.data.length]!;
