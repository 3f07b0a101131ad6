import { element } from "../panel.ts";
import type { LimitsPart } from "../wire/messages.ts";

/** A limit that is in use: what it bounds, its value with the unit, and what happens there. */
export interface LimitFigure {
  readonly label: string;
  readonly value: string;
  readonly help: string;
}

const CUT = "The force is cut to it, and the header says so.";
const FAULT = "Beyond it the loop ends the force with a fault.";
const duration = (seconds: number): string => (seconds < 1 ? `${number(seconds * 1e3)} ms` : `${number(seconds)} s`);
const number = (value: number): string => String(Number(value.toPrecision(6)));

/** The limits of docs/safety.md, as the present runs have them. */
export function limitFigures(limits: LimitsPart): LimitFigure[] {
  const { continuous_force: rms, continuous_time: time, dead_man_buttons: buttons } = limits;
  return [
    { label: "peak force", value: `${number(limits.max_force)} N`, help: CUT },
    { label: "long-run force", value: `${number(rms)} N rms in any ${number(time)} s`, help: CUT },
    {
      label: "warm motors",
      value: `from ${number(limits.warm_motor * 100)} %`,
      help: `Where the device reports it. ${CUT}`,
    },
    {
      label: "ramp after arming",
      value: `${number(limits.ramp_time)} s`,
      help: "The force grows from zero in this time.",
    },
    { label: "speed of the hand", value: `${number(limits.max_speed)} m/s`, help: FAULT },
    { label: "same reading again", value: duration(limits.stale), help: FAULT },
    { label: "late tick", value: duration(limits.deadline), help: FAULT },
    {
      label: "needle’s direction",
      value: `length 1 ± ${number(limits.axis_tolerance)}`,
      help: `Of the direction that the device reports. ${FAULT}`,
    },
    {
      label: "dead-man button",
      value: buttons.length ? `button ${buttons.join(" or ")}` : "none",
      help: "There is no force while none of these buttons is held.",
    },
  ];
}

/** The limits as a list; empty until they are known. */
export function limitList(): { root: HTMLElement; show(limits: LimitsPart): void } {
  const list = element("dl", {});
  const show = (limits: LimitsPart): void =>
    list.replaceChildren(
      ...limitFigures(limits).map(({ label, value, help }) =>
        element("div", { title: help }, element("dt", {}, label), element("dd", {}, value)),
      ),
    );
  return { root: element("section", { class: "health-limits" }, element("h3", {}, "Limits in use"), list), show };
}
