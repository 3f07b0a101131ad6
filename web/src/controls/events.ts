import { element, named } from "../panel.ts";
import { plotsOf } from "../plots/shared.ts";
import { SHOW_AGAIN, showAgain } from "../pop/again.ts";
import type { App } from "../state/app.ts";
import { keptWords } from "../state/source.ts";
import type { MembraneEvent } from "../wire/messages.ts";
import { badge } from "./badge.ts";
import { eventsSince, eventWords, popSentence } from "./words.ts";

const SHOWN = 100;

/** The list of events, newest first. A click shows the event in the plots. */
export function eventList(app: App): HTMLElement {
  const plots = plotsOf(app);
  const list = element("ol", { class: "events-list", reversed: true });
  const empty = element("p", { class: "events-none" }, "No contact yet.");
  const spoken = element("p", { class: "only-read", "aria-live": "polite" });

  const againButton = (event: MembraneEvent): HTMLButtonElement => {
    const label = `${SHOW_AGAIN}: ${event.name}, ${event.time.toFixed(3)} s`;
    const act = (): boolean => showAgain(app, event);
    return element(
      "button",
      { type: "button", class: "event-again", title: SHOW_AGAIN, "aria-label": label, onclick: act },
      "Again",
    );
  };
  const row = (event: MembraneEvent): HTMLLIElement => {
    const { word, force } = eventWords(event, app.source.value.history);
    const go = (): void => {
      if (!plots.jump(event.tick))
        app.notify(`This moment is too old for the plots: they keep ${keptWords(app.live)}.`);
    };
    return element(
      "li",
      {},
      element(
        "button",
        { type: "button", class: `event ${event.what}`, title: "Show this moment in the plots", onclick: go },
        element("span", { class: "event-time" }, `${event.time.toFixed(3)} s`),
        badge(event.membrane),
        named(element("span", { class: "event-name" }), event.name),
        element("span", { class: "event-what" }, word),
        element("span", { class: "event-force" }, force),
      ),
      ...(event.what === "pop" ? [againButton(event)] : []),
    );
  };

  let shown: readonly MembraneEvent[] = [];
  const show = (events: readonly MembraneEvent[]): void => {
    const fresh = eventsSince(shown, events);
    if (fresh === null || events.length === 0) list.replaceChildren();
    for (const event of (fresh ?? events).slice(-SHOWN)) list.prepend(row(event));
    while (list.childElementCount > SHOWN) list.lastElementChild!.remove();
    const pop = fresh && shown.length ? fresh.findLast((event) => event.what === "pop") : undefined;
    if (pop && app.source.value.live) spoken.textContent = popSentence(pop, app.source.value.history);
    shown = events;
    empty.hidden = events.length > 0;
  };
  let leave = (): void => {};
  app.source.watch((source) => {
    leave();
    shown = [];
    list.replaceChildren();
    leave = source.events.watch(show);
  });
  return element("div", { class: "events" }, empty, list, spoken);
}
