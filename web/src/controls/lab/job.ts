import type { Api } from "../../wire/api.ts";
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

/** Yields the JSON values of a body that has one in each line, as they come. */
export async function* jsonLines<T>(body: ReadableStream<Uint8Array>): AsyncGenerator<T> {
  const reader = body.getReader();
  const decoder = new TextDecoder();
  let rest = "";
  for (;;) {
    const { done, value } = await reader.read();
    rest += decoder.decode(value, { stream: !done });
    const lines = rest.split("\n");
    rest = lines.pop()!;
    for (const line of lines) if (line) yield JSON.parse(line) as T;
    if (done) break;
  }
  if (rest.trim()) yield JSON.parse(rest) as T;
}
