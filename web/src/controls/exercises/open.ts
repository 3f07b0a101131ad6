import { element } from "../../panel.ts";
import type { App } from "../../state/app.ts";
import { blockOf, watchBlock } from "../blocked.ts";
import { dropZone, type Kind } from "../drop_zone.ts";
import { sentence } from "../editor/problems.ts";

const MOST_KB = 64; // the studio refuses a larger file
const EXERCISE: Kind = {
  label: "Exercise file",
  button: "Open an exercise file…",
  accept: ".toml",
  help: "A TOML file with a ready scene, such as one that was made here. The studio keeps a copy.",
  takes: (name) => /\.toml$/i.test(name),
  tab: "exercises",
};

/** The name of an exercise: that of its file, without the ending. */
export const stemOf = (file: string): string => file.replace(/(?<=.)\.[^.]*$/, "");

/** The bytes in base64. */
export function base64(bytes: Uint8Array): string {
  let text = "";
  for (let at = 0; at < bytes.length; at += 8192) text += String.fromCharCode(...bytes.subarray(at, at + 8192));
  return btoa(text);
}

/**
 * Opens an exercise file of this computer: the studio checks it and keeps it, then it is in the list. `opened` gets its
 * name.
 */
export function openPart(app: App, opened: (name: string) => Promise<void>): HTMLElement {
  const good = element("p", { class: "quiet", role: "status" });
  const why = element("p", { class: "error" });
  const places = element("ul", { class: "file-problems" });
  const wrong = element("div", { role: "alert", hidden: true }, why, places);
  const replace = element("button", { type: "button", class: "small", hidden: true });
  let asked: () => void = () => {};
  replace.addEventListener("click", () => asked());

  const complain = (text = "", problems: readonly string[] = []): void => {
    why.textContent = text;
    places.replaceChildren(...problems.map((problem) => element("li", {}, problem)));
    places.hidden = problems.length === 0; // an empty list is no list
    wrong.hidden = text === "";
    if (text !== "") root.scrollIntoView({ block: "nearest" }); // the tab of a dropped file opens at its top
  };
  const take = async (file: File, over = false): Promise<void> => {
    good.textContent = "";
    replace.hidden = true;
    complain();
    if (app.exercise.value?.running) {
      app.notify(`${file.name} was not opened: an exercise is running; end it first.`); // this part is hidden
      return;
    }
    const block = blockOf(app);
    if (block) {
      complain(`${file.name} was not opened. ${block.reason}`);
      return;
    }
    if (file.size > MOST_KB * 1000) {
      complain(`${file.name} was not opened: it is larger than ${MOST_KB} kB, and no exercise needs that.`);
      return;
    }
    const bytes = await file.arrayBuffer().catch(() => null);
    if (!bytes) {
      complain(`${file.name} cannot be read. Choose it again.`);
      return;
    }
    const name = stemOf(file.name);
    const request = { do: "open_exercise", name, file: base64(new Uint8Array(bytes)), replace: over } as const;
    const reply = await app.ask(request);
    if (!reply) complain(`${file.name} was not opened: no connection.`);
    else if (reply.ok) {
      good.textContent = [`${file.name} is in the list.`, reply.text].filter(Boolean).join(" ");
      await opened(String(reply.data.name ?? name));
    } else if (reply.problems.length) complain(`${file.name} was not opened:`, reply.problems.map(sentence));
    else {
      // The name is taken: whoever means the same exercise need not choose the file again.
      asked = () => void take(file, true);
      replace.textContent = `Replace ${name}`;
      replace.hidden = over || !reply.data.exists;
      complain(`${file.name} was not opened: ${reply.text}.`);
    }
  };
  const zone = element(
    "fieldset",
    {},
    dropZone(EXERCISE, (file) => void take(file)),
    replace,
  );
  watchBlock(app, (block) => {
    zone.disabled = block !== null;
  });
  const root = element("div", { class: "open-exercise" }, zone, good, wrong);
  return root;
}
