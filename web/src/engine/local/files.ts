import { Api, type Fetch } from "../../wire/api.ts";
import type { Tables } from "./core.ts";
import { tomlOf } from "./toml.ts";
import { NEEDS_STUDIO } from "./words.ts";

/** The files of the static folder that stand for the server's. */
const SCHEMA = "/api/schema";
const SCENE = "/api/scene.toml";

/** The files of a page without a server: the schema of scenes, and the present scene to save. */
export class LocalFiles extends Api {
  /** tables: of the present scene. */
  constructor(
    base: string,
    private readonly tables: () => Tables | null,
  ) {
    const fetcher: Fetch = (path, init) =>
      path === SCHEMA
        ? fetch(new URL("schema.json", base), init)
        : Promise.resolve(new Response(NEEDS_STUDIO, { status: 501 }));
    super("", fetcher);
  }

  override address(path: string): string {
    if (path !== SCENE) return super.address(path);
    return `data:application/toml;charset=utf-8,${encodeURIComponent(tomlOf(this.tables() ?? {}))}`;
  }
}
