import type { App } from "../../state/app.ts";
import { arrangementsOf } from "./arrange.ts";
import { menu } from "./menu.ts";

/** The menu Layout of the header. */
export function layoutMenu(app: App): HTMLElement {
  const all = arrangementsOf(app);
  return menu("Layout", "Layout", () => {
    const { projector } = all.now.value;
    return [
      [
        projector ? "All panels" : "Projector: view and one plot, large",
        () => all.set({ projector: !projector }),
        "Alt+P",
      ],
      ["Default layout", () => all.reset()],
    ];
  });
}
