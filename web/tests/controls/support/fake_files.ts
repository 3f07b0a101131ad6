import { Api, type Fetch } from "../../../src/wire/api.ts";

export type Files = Readonly<Record<string, unknown>>;

/** An Api whose server is a table: path -> JSON value, or a Response. */
export function fakeFiles(files: Files, seen: string[] = []): Api {
  const fetcher: Fetch = async (path, init) => {
    seen.push(`${init?.method ?? "GET"} ${path}`);
    const found = files[path];
    if (found === undefined) return new Response("", { status: 404 });
    return found instanceof Response ? found.clone() : Response.json(found);
  };
  return new Api("secret", fetcher);
}
