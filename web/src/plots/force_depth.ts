import type { Panel } from "../panel.ts";

export const forceDepthPlot: Panel = (_host, _app) => {};
