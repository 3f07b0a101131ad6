import "./style.css";
import { SocketEngine } from "./engine/socket_engine.ts";
import { layout } from "./layout.ts";
import { App } from "./state/app.ts";

const app = new App(new SocketEngine(window.location));
layout(document.getElementById("app") as HTMLElement, app);
app.start();
