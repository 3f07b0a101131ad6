import type { Panel } from "../panel.ts";

export const phasesPanel: Panel = (_host, _app) => {};
