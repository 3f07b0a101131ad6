import "./style.css";
import { SocketEngine } from "./engine/socket_engine.ts";
import { layout } from "./layout.ts";
import { App } from "./state/app.ts";
import { takeToken } from "./state/remembered.ts";
import { Api } from "./wire/api.ts";

const token = takeToken();
const app = new App(new SocketEngine(window.location, token), new Api(token));
layout(document.getElementById("app") as HTMLElement, app);
app.start();
