import { element } from "../panel.ts";
import type { LimitsPart } from "../wire/messages.ts";

/** A limit in use: its label, its value with the unit, and its effect. */
export interface LimitFigure {
  readonly label: string;
  readonly value: string;
  readonly help: string;
}

const CUT = "The force is cut to this limit, and the header shows it.";
const FAULT = "Beyond this limit, a fault ends the force.";
const duration = (seconds: number): string => (seconds < 1 ? `${number(seconds * 1e3)} ms` : `${number(seconds)} s`);
export const number = (value: number): string => String(Number(value.toPrecision(6)));

/** The limits of docs/safety.md with the values in use. */
export function limitFigures(limits: LimitsPart): LimitFigure[] {
  const { continuous_force: rms, continuous_time: time, dead_man_buttons: buttons } = limits;
  return [
    { label: "peak force", value: `${number(limits.max_force)} N`, help: CUT },
    { label: "long-run force", value: `${number(rms)} N rms in any ${number(time)} s`, help: CUT },
    {
      label: "warm motors",
      value: `from ${number(limits.warm_motor * 100)} %`,
      help: `Only if the device reports its motors’ temperature. ${CUT}`,
    },
    {
      label: "ramp of the force",
      value: `${number(limits.ramp_time)} s`,
      help: "After it is turned on, the force grows from zero to full in this time.",
    },
    { label: "speed of the hand", value: `${number(limits.max_speed)} m/s`, help: FAULT },
    { label: "same reading again", value: duration(limits.stale), help: FAULT },
    { label: "late tick", value: duration(limits.deadline), help: FAULT },
    {
      label: "needle’s direction",
      value: `length 1 ± ${number(limits.axis_tolerance)}`,
      help: `Length of the direction vector that the device reports. ${FAULT}`,
    },
    {
      label: "dead-man button",
      value: buttons.length ? `button ${buttons.join(" or ")}` : "none",
      help: "Force needs one of these buttons to be held.",
    },
  ];
}

/** The list of limits; empty until the server sends them. */
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
