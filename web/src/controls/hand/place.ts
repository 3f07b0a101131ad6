import { fixedNumber } from "../../format.ts";
import type { Hand } from "../../hand/hand.ts";
import { button, element, everyFrame } from "../../panel.ts";
import { KEYS } from "../../scene/keys.ts";
import type { App } from "../../state/app.ts";

const number = (metres: number | undefined): string => fixedNumber(metres && 1e3 * metres, 2);

const INTERVAL = 100; // ms between updates; faster ones cannot be read
const LAG_UNKNOWN = "– mm";

/** The lag of the tip behind the hand as text; unknown without a target. */
export const lagText = (metres: number | null): string =>
  metres === null ? LAG_UNKNOWN : `${(metres * 1e3).toFixed(2)} mm`;

/** The positions of hand and tip, and buttons that move the hand. */
export function placeRows(app: App, hand: Hand): HTMLElement {
  const cells = [0, 1].map(() => [0, 1, 2].map(() => element("td", {}, "–")));
  const lag = element("output", { class: "figure" }, LAG_UNKNOWN);
  const head = element(
    "tr",
    {},
    element("th", {}),
    ...["x", "y", "z"].map((axis) => element("th", { scope: "col" }, axis)),
  );
  const rows = ["Hand", "Tip"].map((name, i) => element("tr", {}, element("th", { scope: "row" }, name), ...cells[i]!));
  const table = element(
    "table",
    { class: "place" },
    element("caption", { class: "only-read" }, "Positions in mm"),
    head,
    ...rows,
  );
  let last = 0;
  everyFrame((now) => {
    if (now - last < INTERVAL) return;
    last = now;
    if (table.offsetParent === null) return; // another tab is open
    const target = hand.target.value?.position;
    const { history } = app.live;
    const tip = history.length ? history.row("tip", history.end - 1) : undefined;
    [target, tip].forEach((place, row) => {
      cells[row]!.forEach((cell, i) => {
        const text = number(place?.[i]);
        if (cell.textContent !== text) cell.textContent = text;
      });
    });
    const behind = lagText(hand.lag());
    if (lag.textContent !== behind) lag.textContent = behind;
  });
  return element(
    "section",
    { class: "rows" },
    element("h3", {}, "Position, mm"),
    table,
    element("div", { class: "row" }, element("span", {}, "The tip lags the hand by"), lag),
    element(
      "div",
      { class: "row buttons" },
      button("Out 1 mm", "Along the needle", () => hand.push(-1e-3), "button"),
      button("In 1 mm", "Along the needle", () => hand.push(1e-3), "button"),
      button("Home", "In front of the first membrane", () => hand.home(), "button"),
    ),
  );
}

/** The keys that work while the view has the focus. */
export function keyHelp(): HTMLElement {
  const list = element("dl", {});
  for (const [keys, what] of KEYS) list.append(element("dt", {}, keys), element("dd", {}, what));
  return element("details", { class: "keys" }, element("summary", {}, "Keys, while the view has the focus"), list);
}
