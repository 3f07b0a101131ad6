import { errorText } from "../../../format.ts";
import { element } from "../../../panel.ts";
import type { App } from "../../../state/app.ts";
import { dropZone, type Kind } from "../../drop_zone.ts";
import { type Form, questions } from "./form.ts";
import { type Answers, FieldError, identify, lookAt, refusalOf } from "./job.ts";
import { tracePlot } from "./plot.ts";
import { traceDialog } from "./result.ts";

const TRACE: Kind = {
  label: "File of a trace",
  button: "Choose a file…",
  accept: ".csv,.txt,.tsv,.tra,.lvm,.json,.jsonl,.parquet,.mat,.xlsx,.xlsm,.xls,.h5,.hdf5,.tdms,.bag",
  help: "Force against depth as a machine writes it (CSV, XLSX, LVM, JSON, MAT), or a recording; at most 32 MB.",
  takes: (name) => !/\.toml$/i.test(name), // that is an exercise
  tab: "lab",
};

/** "Identify a measured trace": a file is dropped, looked at, asked about and identified. */
export function tracePart(app: App): HTMLElement {
  const zone = dropZone(TRACE, (file) => void look(file));
  const bar = element("progress", { "aria-label": "Progress of the identification" });
  const step = element("span", { class: "quiet" });
  const cancel = element("button", { type: "button", class: "small" }, "Cancel");
  const progress = element("div", { class: "tools progress", role: "status", hidden: true }, bar, step, cancel);
  const trouble = element("p", { class: "error", role: "alert" });
  const known = element("p", { class: "quiet", role: "status" });
  const drawn = element("div");
  const asked = element("div");
  const again = element("button", { type: "button", class: "small", hidden: true }, "Show the result");
  const place = element("div", {}, progress);
  let running: AbortController | null = null;
  let next: File | null = null; // dropped while another one is computed
  let form: Form | null = null;
  const dialog = traceDialog(app, progress, () => place.append(progress));
  cancel.addEventListener("click", () => running?.abort());
  again.addEventListener("click", () => dialog.open());

  /** Runs one job at a time. Returns why it ended early; empty if it did not. */
  const run = async (words: string, job: (signal: AbortSignal) => Promise<void>): Promise<string> => {
    const stop = new AbortController();
    running = stop;
    trouble.textContent = "";
    show(words, null);
    progress.hidden = false;
    form?.lock(true);
    try {
      await job(stop.signal);
      return "";
    } catch (error) {
      if (stop.signal.aborted) return "Cancelled.";
      const at = error instanceof FieldError && (form?.complain(error.field, error.message) ?? false);
      if (!at) trouble.textContent = errorText(error);
      return errorText(error);
    } finally {
      running = null;
      progress.hidden = true;
      form?.lock(false);
    }
  };
  const show = (words: string, share: number | null): void => {
    step.textContent = words;
    if (share === null) bar.removeAttribute("value");
    else bar.value = share;
  };

  const look = async (file: File): Promise<void> => {
    if (running) {
      next = file;
      known.textContent = `${file.name} waits until the present computation is done.`;
      return;
    }
    form = null;
    asked.replaceChildren();
    drawn.replaceChildren();
    known.textContent = "";
    trouble.textContent = refusalOf(file);
    if (trouble.textContent) return;
    await run(`reading ${file.name}…`, async (signal) => {
      const { file: found, trace } = await lookAt(app.api, file, signal, (words) => show(words, null));
      if (trace) tracePlot(drawn, trace);
      const states = found.needle ? "a recording: it states everything" : `${found.columns.length} columns`;
      known.textContent = `${found.name}: ${found.rows} rows, ${states}.`;
      form = questions(app, found, (answers) => void start(file, found.name, answers));
      asked.replaceChildren(form.root);
      form.root.querySelector<HTMLElement>("select, input")?.focus();
    });
    goOn();
  };

  const start = async (file: File, name: string, answers: Answers): Promise<void> => {
    if (running) return;
    dialog.begin(name);
    again.hidden = true;
    const why = await run("starting…", async (signal) => {
      for await (const line of identify(app.api, file, answers, signal)) {
        dialog.take(line);
        if (line.kind === "step") show(line.words, line.share);
        else if (line.kind === "trace") {
          again.hidden = false;
          dialog.open();
        }
      }
    });
    dialog.end(why);
    goOn();
  };
  const goOn = (): void => {
    const file = next;
    next = null;
    if (file) void look(file);
  };

  return element(
    "section",
    { class: "trace-part" },
    element("h3", {}, "Identify a measured trace"),
    zone,
    trouble,
    known,
    drawn,
    asked,
    place,
    again,
  );
}
