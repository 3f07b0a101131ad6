import type { LiveRun, Punctura } from "../../../src/engine/local/core.ts";
import { decodeTicks } from "../../../src/wire/ticks.ts";
import { makeFrame } from "../../wire/frame.ts";

/** A core whose runs only remember what they are told. The run of a scene with the text BAD has a problem. */
export class FakeCore {
  readonly told: string[] = [];
  /** The fault of the ticks from now on. */
  fault = 0;
  /** Of the scene. */
  syringe: { bore: number; volume: number } | null = null;

  get punctura(): Punctura {
    const core = this;
    class FakeRun {
      readonly rate = 1600;
      strokesNow = false;
      private tick = 0;
      constructor(
        toml: string,
        private readonly options: { number: number },
      ) {
        core.check(toml);
        core.told.push(`run ${options.number}: ${/name = "(.*)"/.exec(toml)?.[1]}`);
      }
      get scene() {
        return { number: 0, membranes: [], laws: [], syringe: core.syringe };
      }
      exchange(toml: string): void {
        core.check(toml);
        core.told.push("exchange");
      }
      advance(count: number): ArrayBuffer {
        this.tick += count;
        const frame = makeFrame({ run: this.options.number, first: this.tick - count, count, membranes: 1 });
        decodeTicks(frame).bytes.fault.fill(core.fault); // a view of the frame
        return frame;
      }
      messages() {
        return [{ kind: "laws", laws: [] }];
      }
      strokes(period: number): void {
        this.strokesNow = true;
        core.told.push(`strokes ${period}`);
      }
      pushPlunger(force: number): void {
        core.told.push(`push ${force}`);
      }
      target(position: readonly number[]): void {
        this.strokesNow = false;
        core.told.push(`target ${position}`);
      }
      arm = () => core.told.push("arm");
      pause = () => core.told.push("pause");
      reset = () => core.told.push("reset");
      trip = () => core.told.push("trip");
      free = () => core.told.push("free");
      compare = (on: boolean) => core.told.push(`compare ${on}`);
      estimate = (on: boolean) => core.told.push(`estimate ${on}`);
    }
    const about = { device: { model: "fake", simulated: true }, limits: {} };
    return {
      LiveRun: Object.assign(FakeRun as unknown as new () => LiveRun, { about }),
      tablesOf: (toml: string) =>
        toml.includes("[[goal]]") ? { goal: [{}] } : { name: /name = "(.*)"/.exec(toml)?.[1] },
    } as unknown as Punctura;
  }

  private check(toml: string): void {
    if (!toml.includes("BAD")) return;
    const problems = [{ path: "membrane[0].friction", value: -1, reason: "must be greater than 0" }];
    throw Object.assign(new Error("bad"), { problems });
  }
}
