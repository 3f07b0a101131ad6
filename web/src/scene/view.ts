import type { Panel } from "../panel.ts";

export const view: Panel = (_host, _app) => {};
