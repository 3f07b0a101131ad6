// Punctura in WebAssembly. SI units. Types and comments for users: punctura.d.mts. The C functions: punctura.h.
import { liveRunOf } from "./live.mjs";
import { Memory } from "./memory.mjs";
import { steppersOf } from "./steppers.mjs";

export { PuncturaError } from "./memory.mjs";

export async function load(source) {
  const memory = await Memory.load(source);
  const { c } = memory;
  return {
    version: memory.text(c.punctura_version()),
    ...steppersOf(memory),
    LiveRun: liveRunOf(memory),
    tablesOf(toml) {
      const json = memory.withText(toml, (at, size) => memory.text(c.live_tables(at, size)));
      return json === "" ? null : JSON.parse(json);
    },
  };
}
