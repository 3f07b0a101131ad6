import type { Panel } from "../panel.ts";

export const headerBar: Panel = (_host, _app) => {};
