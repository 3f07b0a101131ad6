import { type Api, ApiError } from "../../../wire/api.ts";
import type { FileLine, IdentifyLine, TraceLine } from "../../../wire/messages.ts";
import { jsonLines } from "../job.ts";

export const LARGEST = 32e6; // bytes of a file; the studio takes no more

/** What the user says of a file: columns and units by role, the needle, the number of membranes. */
export interface Answers {
  readonly columns: Readonly<Record<string, string>>;
  readonly units: Readonly<Record<string, string>>;
  readonly order: "recorded" | "depth";
  readonly diameter: number; // mm
  readonly angle: number; // degrees
  readonly membranes: string;
}

/** A value that the studio refuses. field: its name, or empty. */
export class FieldError extends Error {
  constructor(
    message: string,
    readonly field: string,
  ) {
    super(message);
  }
}

/** The reason why a file is not sent; empty if it can be. */
export function refusalOf({ name, size }: Pick<File, "name" | "size">): string {
  if (/\.toml$/i.test(name)) return `${name} is a scene file: load it in the tab Scene.`;
  if (size === 0) return `${name} is empty.`;
  if (size <= LARGEST) return "";
  const most = `at most ${LARGEST / 1e6} MB`;
  return `${name} has ${(size / 1e6).toFixed(0)} MB; ${most}. Leave out samples, or use punctura identify.`;
}

export function queryOf(name: string, answers: Answers): string {
  const pairs = (key: string, values: Readonly<Record<string, string>>): string[][] =>
    Object.entries(values).map(([role, value]) => [key, `${role}=${value}`]);
  return new URLSearchParams([
    ["name", name],
    ["diameter_mm", String(answers.diameter)],
    ["tip_angle_deg", String(answers.angle)],
    ["membranes", answers.membranes],
    ["order", answers.order],
    ...pairs("column", answers.columns),
    ...pairs("unit", answers.units),
  ]).toString();
}

/** What a file holds, and its trace if the file states everything. */
export interface Look {
  readonly file: FileLine;
  readonly trace: TraceLine | null;
}

/** Looks into a file. report: gets words while it waits. Throws ApiError, FieldError, or the signal's reason. */
export async function lookAt(
  api: Api,
  file: File,
  signal: AbortSignal,
  report: (words: string) => void,
): Promise<Look> {
  const query = new URLSearchParams({ name: file.name });
  let held: FileLine | null = null;
  let trace: TraceLine | null = null;
  for await (const line of linesOf(api, `/api/lab/file?${query}`, file, signal)) {
    if (line.kind === "step") report(line.words);
    else if (line.kind === "file") held = line;
    else if (line.kind === "trace") trace = line;
  }
  if (!held) throw new ApiError("The studio sent no answer.");
  return { file: held, trace };
}

/** The lines of an identification as they come. Throws as `lookAt` does. */
export const identify = (api: Api, file: File, answers: Answers, signal: AbortSignal): AsyncGenerator<IdentifyLine> =>
  linesOf(api, `/api/lab/identify?${queryOf(file.name, answers)}`, file, signal);

async function* linesOf(api: Api, path: string, file: File, signal: AbortSignal): AsyncGenerator<IdentifyLine> {
  const response = await api.send(path, file, signal);
  if (!response.body) return;
  for await (const line of jsonLines<IdentifyLine>(response.body)) {
    if (line.kind === "error") throw new FieldError(line.text, line.field ?? "");
    yield line;
  }
}
