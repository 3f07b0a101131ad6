import type { Triple } from "../engine/engine.ts";
import type { Pose } from "../hand/hand.ts";
import type { Source } from "../state/source.ts";

/**
 * Where the needle of the run that is laid over was, as long after its first contact as this tick is after that of the
 * replayed run. Null if one of the two has no contact, or if that moment was not recorded.
 */
export function poseBeside(source: Source, over: Source | null, tick: number): Pose | null {
  const [touch, other] = [source, over].map((run) => run?.events.value.find(({ what }) => what === "touch")?.time);
  const scene = over?.scene.value;
  if (!over || !scene || source.live || touch === undefined || other === undefined) return null;
  const { history } = over;
  const wanted = source.history.timeOf(tick) - touch + other;
  const at = Math.round(history.first + (wanted - history.timeOf(history.first)) * scene.rate);
  if (!(at >= history.first && at < history.end)) return null;
  const [position, axis] = [history.row("tip", at), history.row("axis", at)];
  if (![...position, ...axis].every(Number.isFinite)) return null;
  return { position: [...position] as unknown as Triple, axis: [...axis] as unknown as Triple };
}
