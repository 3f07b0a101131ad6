// The page with a made-up run, for looking at panels without a server: never part of the product.
// ?seconds=20 of run are there at once, ?compare=1 shows the other solver.
import "../../src/style.css";
import { layout } from "../../src/layout.ts";
import { App } from "../../src/state/app.ts";
import { FakeEngine } from "./fake_engine.ts";

const asked = new URLSearchParams(location.search);
const engine = new FakeEngine(Number(asked.get("seconds") ?? 20));
engine.compare = asked.get("compare") === "1";
const app = new App(engine);
layout(document.getElementById("app") as HTMLElement, app);
app.start();
Object.assign(window, { app });
