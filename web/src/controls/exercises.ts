import type { Panel } from "../panel.ts";

export const exercisesPanel: Panel = (_host, _app) => {};
