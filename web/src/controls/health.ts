import type { Panel } from "../panel.ts";

export const healthPanel: Panel = (_host, _app) => {};
