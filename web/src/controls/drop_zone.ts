import { button, element } from "../panel.ts";

/** The files that a zone takes. */
export interface Kind {
  /** What the file is, for a screen reader. */
  readonly label: string;
  /** The text of the button. */
  readonly button: string;
  /** The endings that the browser offers, such as ".toml". */
  readonly accept: string;
  /** A sentence below the button. */
  readonly help: string;
  /** Whether a file of this name belongs here if it is dropped anywhere in the page. */
  readonly takes: (name: string) => boolean;
  /** The tab that opens then. */
  readonly tab: string;
}

const holdsFiles = (event: DragEvent): boolean => event.dataTransfer?.types.includes("Files") ?? false;

/**
 * A button that chooses a file, and a zone to drop one. A file of the kind that is dropped anywhere else in the page is
 * taken, too: without this, the browser would leave the page and open the file.
 */
export function dropZone(kind: Kind, take: (file: File) => void): HTMLElement {
  const input = element("input", { type: "file", accept: kind.accept, hidden: true, "aria-label": kind.label });
  const choose = button(kind.button, "", () => input.click());
  input.addEventListener("change", () => {
    const [file] = input.files ?? [];
    if (file) take(file);
    input.value = "";
  });
  const zone = element(
    "div",
    { class: "drop-zone" },
    choose,
    element("span", { class: "quiet" }, " or drop it here."),
    element("p", { class: "quiet" }, kind.help),
    input,
  );
  const over = (event: DragEvent): void => {
    if (!holdsFiles(event)) return;
    event.preventDefault();
    zone.classList.add("over");
  };
  const leave = (event: DragEvent): void => {
    if (event.relatedTarget === null) zone.classList.remove("over");
  };
  const drop = (event: DragEvent): void => {
    if (!holdsFiles(event)) return;
    event.preventDefault();
    zone.classList.remove("over");
    const [file] = event.dataTransfer?.files ?? [];
    if (!file || !kind.takes(file.name) || document.querySelector("dialog[open]")) return;
    document.getElementById(`tab-${kind.tab}`)?.click();
    take(file);
  };
  window.addEventListener("dragover", over);
  window.addEventListener("dragleave", leave);
  window.addEventListener("drop", drop);
  return zone;
}
