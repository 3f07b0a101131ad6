import type { Panel } from "../panel.ts";

export const faultBanner: Panel = (_host, _app) => {};
