import { element, type Panel } from "../panel.ts";
import type { RecordingEntry, Result, SceneField } from "../wire/messages.ts";
import { estimatePart } from "./lab/estimate.ts";
import { compute, type Job } from "./lab/job.ts";
import { pickRuns } from "./lab/pick.ts";
import { openComparison } from "./lab/result.ts";
import { tracePart } from "./lab/trace/part.ts";
import { varyForm } from "./lab/vary.ts";
import { needsStudio } from "./needs_studio.ts";
import { wordsOf } from "./recordings/library.ts";

/** Identifies measured traces, compares recordings, and varies a parameter of the scene through simulated runs. */
export const labPanel: Panel = (host, app) => {
  if (app.engine.studio) comparisons(host, app);
  else host.append(needsStudio("Identifying a measured trace, comparing recordings and varying a parameter need"));
  host.append(estimatePart(app));
};

const comparisons: Panel = (host, app) => {
  const bar = element("progress", { max: 1, value: 0, "aria-label": "Progress of the computation" });
  const words = element("span", { class: "quiet" });
  const cancel = element("button", { type: "button", class: "small" }, "Cancel");
  const progress = element("div", { class: "tools progress", role: "status", hidden: true }, bar, words, cancel);
  const trouble = element("p", { class: "error", role: "alert" });
  let running: AbortController | null = null;
  cancel.addEventListener("click", () => running?.abort());

  const start = async (job: Job, title: string): Promise<void> => {
    if (running) return;
    const stop = new AbortController();
    running = stop;
    trouble.textContent = "";
    progress.hidden = false;
    bar.value = 0;
    words.textContent = "computing…";
    try {
      const report = (share: number, run: string): void => {
        bar.value = share;
        words.textContent = run;
      };
      openComparison(app, job, title, await compute(app.api, job, report, stop.signal));
    } catch (error) {
      if (!stop.signal.aborted) trouble.textContent = wordsOf(error);
    } finally {
      running = null;
      progress.hidden = true;
    }
  };
  const picked = pickRuns((names) => void start({ recordings: names }, `${names.length} recordings compared`));
  const vary = varyForm((job, title) => void start(job, title));
  host.append(tracePart(app), picked.root, vary.root, progress, trouble);

  const refresh = async (): Promise<void> => {
    try {
      const [entries, results] = await Promise.all([
        app.api.json<RecordingEntry[]>("/api/recordings"),
        app.api.json<Result[]>("/api/results"),
      ]);
      picked.offer(entries, results);
      const fields = await app.api.json<SceneField[]>("/api/lab/fields");
      vary.offer(fields, entries, app.live.scene.value?.membranes.map(({ name }) => name) ?? []);
    } catch (error) {
      trouble.textContent = wordsOf(error);
    }
  };
  // The panel reads its lists whenever it is opened, and while it is open, when the scene changes.
  let open = false;
  new IntersectionObserver((seen) => {
    open = seen.at(-1)?.isIntersecting ?? false;
    if (open) void refresh();
  }).observe(host);
  app.live.scene.watch(() => {
    if (open) void refresh();
  });
};
