import { button, element } from "../../../panel.ts";
import { download } from "../../../plots/save.ts";
import type { App } from "../../../state/app.ts";
import type { FitLine, IdentifyLine, RivalsLine, TraceLine } from "../../../wire/messages.ts";
import { blockLine, watchBlock } from "../../blocked.ts";
import { fileName } from "../../download.ts";
import { sentence } from "../../editor/problems.ts";
import { type TracePlot, tracePlot } from "./plot.ts";
import { estimatesTable, rivalsTable, triedTable } from "./tables.ts";
import { doubtWords, fitWords, rankWords, withoutOptions } from "./words.ts";

const section = (title: string, ...parts: readonly (Node | string)[]): HTMLElement =>
  element("section", {}, element("h3", {}, title), ...parts);

const list = (sentences: readonly string[]): HTMLElement =>
  element("ul", { class: "trace-list" }, ...sentences.map((text) => element("li", {}, text)));

const findingsPart = ({ findings: found, samples }: TraceLine): HTMLElement =>
  section(
    "Found in the trace",
    found.length
      ? list(found.map(({ kind, text }) => `${kind.replaceAll("_", " ")}: ${withoutOptions(text)}`))
      : element("p", { class: "quiet" }, `Nothing unusual in ${samples} samples.`),
  );

function fitParts(fit: FitLine): HTMLElement[] {
  const count = Math.round(fit.effective_samples);
  return [
    section(
      "Parameters",
      estimatesTable(fit.estimates),
      element(
        "p",
        { class: "quiet" },
        `The intervals count ${count} of the samples as independent: neighbouring residuals may be alike. They hold ` +
          "if the model is right; residuals with a shape say that it is not.",
      ),
    ),
    section(
      "What the trace cannot tell",
      fit.verdicts.length ? list(fit.verdicts.map(doubtWords)) : element("p", {}, "Nothing: all is identifiable."),
    ),
    element("details", {}, element("summary", {}, "Extensions that were tried"), triedTable(fit.tried)),
  ];
}

const rivalsPart = (line: RivalsLine): HTMLElement =>
  section("Other models", ...(line.rows.length ? [rivalsTable(line)] : []), list(line.notes));

const READY = "The scene begins a new run.";

/** The dialog of an identification. It fills while the lines come. */
export interface TraceDialog {
  /** Removes the last result. */
  begin(name: string): void;
  take(line: IdentifyLine): void;
  /** The computation has ended; why, if it ended without all results. */
  end(why: string): void;
  open(): void;
}

/** progress: the line with the present step, shown while the dialog is open. closed: the dialog gives it back. */
export function traceDialog(app: App, progress: HTMLElement, closed: () => void): TraceDialog {
  const verdict = element("p", { class: "why", role: "status" });
  const trouble = element("p", { class: "error", role: "alert" });
  const place = element("div", { class: "trace-place" });
  const [numbers, models] = [element("div"), element("div")];
  const title = element("h2", { id: "trace-title", tabindex: -1 });
  let [name, report, scene] = ["", "", ""];
  const feel = button("Feel this tissue", "Load the scene of these membranes", () => void load(), "small primary");
  const named = (more: string, ending: string): string => fileName(name.replace(/\.\w+$/, "") + more, ending);
  const saveScene = button("Save scene", "Save the scene as a TOML file for punctura run", () =>
    download(named("", "toml"), [scene], "application/toml"),
  );
  const saveReport = button("Save report", "Save the one-page report as an HTML file", () =>
    download(named("-report", "html"), [report], "text/html"),
  );
  let blocked = false;
  const mark = (): void => {
    feel.disabled = blocked || !scene;
    saveScene.disabled = !scene;
    saveReport.disabled = !report;
  };
  watchBlock(
    app,
    (block) => {
      blocked = block !== null;
      mark();
    },
    "scene",
  );
  const load = async (): Promise<void> => {
    trouble.textContent = "";
    const reply = await app.ask({ do: "load_text", toml: scene });
    const problems = (reply?.problems ?? []).map(sentence);
    if (!reply?.ok) trouble.textContent = [reply?.text ?? "No connection.", ...problems].join(" ");
    else {
      dialog.close();
      document.querySelector<HTMLElement>(".panel.view [role=application]")?.focus();
    }
  };
  const dialog = element(
    "dialog",
    { class: "result tab lab-result trace-dialog", "aria-labelledby": "trace-title" },
    element("header", {}, title),
    verdict,
    trouble,
    place,
    numbers,
    models,
    element(
      "footer",
      { class: "trace-footer" },
      blockLine(app, READY, "scene"),
      element(
        "div",
        { class: "tools" },
        feel,
        saveScene,
        saveReport,
        element("span", { class: "gap" }),
        button("Close", "Close", () => dialog.close()),
      ),
    ),
  );
  dialog.addEventListener("close", () => {
    dialog.remove();
    closed();
  });
  let plot: TracePlot | null = null;
  let fitted: FitLine | null = null;
  return {
    begin: (of) => {
      [name, report, scene] = [of, "", ""];
      [plot, fitted] = [null, null];
      title.textContent = name;
      verdict.textContent = trouble.textContent = "";
      for (const part of [place, numbers, models]) part.replaceChildren();
      mark();
    },
    take: (line) => {
      if (line.kind === "trace") {
        plot = tracePlot(place, line);
        numbers.replaceChildren(findingsPart(line));
      } else if (line.kind === "fit") {
        fitted = line;
        plot?.fit(line);
        scene = line.scene;
        if (line.no_scene) trouble.textContent = `These membranes make no scene: ${line.no_scene}`;
        numbers.prepend(...fitParts(line));
        verdict.textContent = fitWords(line);
      } else if (line.kind === "rivals") {
        plot?.others(line);
        models.replaceChildren(rivalsPart(line));
        if (fitted) verdict.textContent = `${fitWords(fitted)} ${rankWords(line)}`;
      } else if (line.kind === "report") report = line.html;
      mark();
    },
    end: (why) => {
      trouble.textContent = why;
      mark();
    },
    open: () => {
      dialog.querySelector("header")!.after(progress);
      document.body.append(dialog);
      dialog.showModal();
      title.focus();
    },
  };
}
