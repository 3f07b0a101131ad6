import "../../../src/style.css";
import { layout } from "../../../src/layout.ts";
import { App } from "../../../src/state/app.ts";
import type { SceneView } from "../../../src/wire/messages.ts";
import { FakeEngine } from "./fake_engine.ts";
import { fakeFiles } from "./fake_files.ts";
import scene from "./scene.json";
import schema from "./schema.json";

// The page without a server, to look at its panels: npx vite, then /tests/controls/support/panels.html.
const app = new App(new FakeEngine(scene as unknown as SceneView), fakeFiles({ "/api/schema": schema }));
layout(document.getElementById("app") as HTMLElement, app);
app.start();
