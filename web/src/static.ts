import "./style.css";
import { LocalFiles } from "./engine/local/files.ts";
import { WorkerEngine } from "./engine/local/worker_engine.ts";
import { layout } from "./layout.ts";
import { App } from "./state/app.ts";

// The entry of the static page, which has no server: tools/build_backend/static_page.py builds it.

const base = new URL(".", window.location.href).href;
const app: App = new App(new WorkerEngine(base), new LocalFiles(base, () => app.live.scene.value?.tables ?? null));
layout(document.getElementById("app") as HTMLElement, app);
app.start();
