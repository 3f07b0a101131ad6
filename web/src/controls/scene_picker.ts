import { element, keptList } from "../panel.ts";
import type { App } from "../state/app.ts";
import type { Choice } from "../wire/messages.ts";

const OWN = "";

/** The list of ready scenes. A scene from a file, or an edited one, comes first. */
export function scenePicker(app: App): HTMLElement {
  const select = element("select", { "aria-label": "Scene", class: "scene-picker" });
  const offer = keptList<Choice>(select, ({ name, title }) => element("option", { value: name }, title));
  const show = (): void => {
    const hello = app.hello.value;
    const scene = app.live.scene.value;
    if (!hello) return;
    const ready = hello.scenes.find(({ name, title }) => title === scene?.name || name === scene?.name);
    offer([...(scene && !ready ? [{ name: OWN, title: scene.name }] : []), ...hello.scenes]);
    select.value = ready?.name ?? OWN;
  };
  app.hello.watch(show);
  app.live.scene.watch(show);
  let loading = false;
  const enable = (): void => {
    select.disabled = loading || !app.control.value.you || app.connection.value.state !== "open";
  };
  app.control.watch(enable);
  app.connection.watch(enable);
  select.addEventListener("change", () => {
    if (select.value === OWN) return;
    loading = true;
    enable();
    void app.ask({ do: "load", scene: select.value }).then((reply) => {
      loading = false;
      enable();
      if (!reply?.ok) show();
    });
  });
  return select;
}
