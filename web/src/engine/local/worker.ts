import { errorText } from "../../format.ts";
import { DONE } from "../engine.ts";
import type { FromWorker, Punctura, StudioData, Tables, ToWorker } from "./core.ts";
import { LocalStudio } from "./studio.ts";

// The worker of the static page: the core in WebAssembly, on a clock of its own.

const BLOCK_MS = 8;
const STATUS_MS = 250;

/** The worker's own scope; the types of TypeScript's DOM library are those of a window. */
const scope = globalThis as unknown as {
  onmessage: ((event: MessageEvent<ToWorker>) => void) | null;
  postMessage(data: FromWorker, transfer?: Transferable[]): void;
};
const send = (data: FromWorker): void => scope.postMessage(data);

/** base: the URL of the static folder. */
async function begin(base: string): Promise<LocalStudio> {
  const at = (name: string): string => new URL(name, base).href;
  const json = async <T>(name: string): Promise<T> => {
    const answer = await fetch(at(name));
    if (!answer.ok) throw new Error(`${name} is missing beside the page: status ${answer.status}`);
    return (await answer.json()) as T;
  };
  const loading = import(/* @vite-ignore */ at("punctura/punctura.mjs")) as Promise<{ load(): Promise<Punctura> }>;
  const [core, data, schema] = await Promise.all([
    loading.then(({ load }) => load()),
    json<StudioData>("studio.json"),
    json<Tables>("schema.json"),
  ]);
  const out = {
    message: (message: Extract<FromWorker, { message: unknown }>["message"]) => send({ message }),
    frame: (frame: ArrayBuffer) => scope.postMessage({ frame }, [frame]),
  };
  const made = new LocalStudio(core, data, schema, out, () => performance.now());
  made.start();
  return made;
}

let studio: LocalStudio | null = null;
let visible = true;
scope.onmessage = ({ data }) => {
  if ("start" in data) {
    begin(data.start).then(
      (made) => {
        studio = made;
        setInterval(() => {
          if (visible) made.turn();
        }, BLOCK_MS);
        setInterval(() => made.tellStatus(), STATUS_MS);
      },
      (error: unknown) => send({ failed: errorText(error) }),
    );
  } else if ("visible" in data) {
    visible = data.visible;
    studio?.sleep();
  } else if ("ask" in data) {
    const answer = studio?.ask(data.ask) ?? { ...DONE, ok: false, text: "The core is not loaded yet." };
    send({ reply: { kind: "reply", id: data.id, ...answer } });
  } else {
    studio?.target(data.run, data.position, data.axis, data.buttons);
  }
};
