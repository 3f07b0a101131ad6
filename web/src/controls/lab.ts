import { errorText } from "../format.ts";
import { button, element, type Panel } from "../panel.ts";
import type { RecordingEntry, Result, SceneField } from "../wire/messages.ts";
import { plainPaths } from "./editor/problems.ts";
import { estimatePart } from "./lab/estimate.ts";
import { runWords } from "./lab/fields.ts";
import { compute, type Job } from "./lab/job.ts";
import { pickRuns } from "./lab/pick.ts";
import { openComparison } from "./lab/result.ts";
import { tracePart } from "./lab/trace/part.ts";
import { varyForm } from "./lab/vary.ts";
import { needsStudio } from "./needs_studio.ts";

const MOST_IN_LINE = 3; // of this page: a browser has six connections to a server, and the page needs some

/** Identifies measured traces, compares recordings, and varies a parameter of the scene through simulated runs. */
export const labPanel: Panel = (host, app) => {
  if (app.engine.studio) comparisons(host, app);
  else host.append(needsStudio("Identifying a measured trace, comparing recordings and varying a parameter need"));
  host.append(estimatePart(app));
};

const comparisons: Panel = (host, app) => {
  const membraneNames = (): string[] => app.live.scene.value?.membranes.map(({ name }) => name) ?? [];
  const inLine = element("div"); // a row for each computation: the studio says how many come before it
  const trouble = element("p", { class: "error", role: "alert" });

  /** The request goes out at once, also where others wait: the scene is that of this moment. */
  const start = async (job: Job, title: string): Promise<void> => {
    trouble.textContent = "";
    if (inLine.childElementCount >= MOST_IN_LINE) {
      trouble.textContent = `${MOST_IN_LINE} computations are in line. Wait until one is done, or cancel one.`;
      return;
    }
    const stop = new AbortController();
    const names = membraneNames();
    const bar = element("progress", { max: 1, value: 0, "aria-label": `Progress: ${title}` });
    const words = element("span", { class: "quiet" }, `${title}: computing…`);
    const cancel = button("Cancel", "", () => stop.abort());
    const row = element("div", { class: "tools progress", role: "status" }, bar, words, cancel);
    inLine.append(row);
    try {
      const report = (share: number, run: string): void => {
        bar.value = Math.max(bar.value, share); // one that waits says 0
        words.textContent = `${title}: ${runWords(run, names)}`;
      };
      const done = await compute(app.api, job, report, stop.signal);
      const statistics = done.statistics.map((run) => ({ ...run, name: runWords(run.name, names) }));
      openComparison(app, job, title, { ...done, statistics });
    } catch (error) {
      if (!stop.signal.aborted) trouble.append(`${title}: ${plainPaths(errorText(error))} `);
    } finally {
      row.remove();
    }
  };
  const picked = pickRuns((names) => void start({ recordings: names }, `${names.length} recordings compared`));
  const vary = varyForm((job, title) => void start(job, title));
  host.append(tracePart(app), picked.root, vary.root, inLine, trouble);

  const refresh = async (): Promise<void> => {
    try {
      const [entries, results] = await Promise.all([
        app.api.json<RecordingEntry[]>("/api/recordings"),
        app.api.json<Result[]>("/api/results"),
      ]);
      picked.offer(entries, results);
      const fields = await app.api.json<SceneField[]>("/api/lab/fields");
      vary.offer(fields, entries, membraneNames());
    } catch (error) {
      trouble.textContent = errorText(error);
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
