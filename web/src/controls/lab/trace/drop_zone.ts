import { element } from "../../../panel.ts";

const FORMATS = ".csv,.txt,.tsv,.parquet,.mat,.xlsx";

const holdsFiles = (event: DragEvent): boolean => event.dataTransfer?.types.includes("Files") ?? false;

/**
 * A button that chooses a file, and a zone to drop one. A file that is dropped anywhere else in the page is taken, too:
 * without this, the browser would leave the page and open the file.
 */
export function dropZone(take: (file: File) => void): HTMLElement {
  const input = element("input", { type: "file", accept: FORMATS, hidden: true, "aria-label": "File of a trace" });
  const choose = element("button", { type: "button", class: "small", onclick: () => input.click() }, "Choose a file…");
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
    element(
      "p",
      { class: "quiet" },
      "Force against depth as CSV, Parquet, XLSX or MAT, or a recording of Punctura; at most 32 MB.",
    ),
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
    if (!file || document.querySelector("dialog[open]")) return;
    document.getElementById("tab-lab")?.click();
    take(file);
  };
  window.addEventListener("dragover", over);
  window.addEventListener("dragleave", leave);
  window.addEventListener("drop", drop);
  return zone;
}
