import type { Panel } from "../panel.ts";

export const notices: Panel = (_host, _app) => {};
