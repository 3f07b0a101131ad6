import type { Api } from "../../wire/api.ts";
import { jsonLines } from "../../wire/lines.ts";
import type { LabComparison, LabLine } from "../../wire/messages.ts";

/** What to compare: recordings by name, or a parameter of the present scene through a list of values. SI. */
export type Job =
  | { readonly recordings: readonly string[] }
  | {
      readonly path: string;
      readonly from: number;
      readonly to: number;
      readonly count: number;
      /** Speed of a stroke, m/s, or the name of a recording whose motion is used. */
      readonly motion: number | string;
      /** The studio keeps the scene of the simulation under this name, for the zip file. */
      readonly id?: string;
    };

export function queryOf(job: Job): string {
  if ("recordings" in job) return new URLSearchParams(job.recordings.map((name) => ["run", name])).toString();
  const { path, from, to, count, motion, id } = job;
  const by = typeof motion === "number" ? { speed: String(motion) } : { motion };
  const values = { from: String(from), to: String(to), count: String(count) };
  return new URLSearchParams({ path, ...values, ...by, ...(id && { id }) }).toString();
}

/** Computes the comparison in the studio. Throws ApiError, Error with the reason, or the signal's reason. */
export async function compute(
  api: Api,
  job: Job,
  progress: (share: number, run: string) => void,
  signal: AbortSignal,
): Promise<LabComparison> {
  const response = await api.get(`/api/lab/compare?${queryOf(job)}`, { signal });
  if (response.body)
    for await (const line of jsonLines<LabLine>(response.body)) {
      if ("share" in line) progress(line.share, line.run);
      else if ("error" in line) throw new Error(line.error);
      else return line.comparison;
    }
  throw new Error("the studio sent no result");
}

/** Address of the zip file with figure, data, scenes and how to cite them. */
export const bundlePath = (job: Job, on: "depth" | "time"): string => `/api/lab/bundle?${queryOf(job)}&on=${on}`;
