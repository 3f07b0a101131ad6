import type { Panel } from "../panel.ts";

export const timePlots: Panel = (_host, _app) => {};
