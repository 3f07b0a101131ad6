import "./style.css";
import { layout } from "./layout.ts";
import { App } from "./state/app.ts";
import { SocketEngine } from "./wire/socket_engine.ts";

const app = new App(new SocketEngine(window.location));
layout(document.getElementById("app") as HTMLElement, app);
app.start();
