import type { Panel } from "../panel.ts";

export const editorPanel: Panel = (_host, _app) => {};
