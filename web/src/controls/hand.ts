import type { Panel } from "../panel.ts";

export const handPanel: Panel = (_host, _app) => {};
