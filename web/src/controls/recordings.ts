import type { Panel } from "../panel.ts";

export const recordingsPanel: Panel = (_host, _app) => {};
