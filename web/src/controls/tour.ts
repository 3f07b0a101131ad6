import type { Panel } from "../panel.ts";

export const tour: Panel = (_host, _app) => {};
