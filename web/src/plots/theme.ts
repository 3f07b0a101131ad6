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

const DATA = ["--data-1", "--data-2", "--data-3", "--data-4", "--data-5"];

/** Calls `changed` with the present colours, and again whenever the page turns light or dark. */
export function watchTheme(changed: (theme: Theme) => void): void {
  const probe = document.createElement("i");
  probe.hidden = true;
  document.body.append(probe);
  // getPropertyValue would return the text light-dark(...); the computed colour of an element is resolved.
  const read = (name: string): string => {
    probe.style.color = `var(${name})`;
    return getComputedStyle(probe).color;
  };
  const tell = (): void =>
    changed({
      panel: read("--panel"),
      line: read("--line"),
      text: read("--text"),
      quiet: read("--quiet"),
      accent: read("--accent"),
      danger: read("--danger"),
      data: DATA.map(read),
    });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", tell);
  new MutationObserver(tell).observe(document.documentElement, { attributes: true });
  tell();
}

export const colourOf = (theme: Theme, membrane: number): string => theme.data[membrane % theme.data.length]!;
