// The frame of the page: the start, or a recording's workspace; dialogs and notices above either.

import { useSignal } from "@preact/signals";
import type { FunctionComponent } from "preact";
import { useEffect } from "preact/hooks";
import { mission } from "../design/mission.ts";
import { IconButton } from "../parts/controls.tsx";
import { Icon } from "../parts/icon.tsx";
import { OrdersDialog } from "../views/commands/orders_dialog.tsx";
import { ValuesDialog } from "../views/plots/values_dialog.tsx";
import { MeshDialog } from "../views/start/mesh_dialog.tsx";
import { DropSign, useMeshDrop } from "../views/start/mesh_drop.tsx";
import { Start } from "../views/start/start.tsx";
import { CommandDialog } from "./command_dialog.tsx";
import { KeysDialog } from "./keys_dialog.tsx";
import { dismiss, notices, tell } from "./notices.ts";
import { overlay } from "./overlay.ts";
import { designing } from "./route.ts";
import { SessionContext, session } from "./session.ts";
import { Workspace } from "./workspace.tsx";

function Notices() {
  return (
    <div class="notices" aria-live="polite">
      {notices.value.map((notice) => (
        <div key={notice.id} class={`notice notice-${notice.kind}`} role={notice.kind === "error" ? "alert" : "status"}>
          <Icon name={notice.kind === "error" ? "error" : "info"} />
          <span>
            <strong>{notice.what}</strong> {notice.remedy}
          </span>
          <IconButton icon="close" label="Close the message" onClick={() => dismiss(notice.id)} />
        </div>
      ))}
    </div>
  );
}

function Overlay() {
  if (overlay.value === "keys") return <KeysDialog />;
  if (overlay.value === "mesh") return <MeshDialog />;
  if (overlay.value === "values" && session.value !== null) return <ValuesDialog />;
  if (overlay.value === "command" && session.value !== null) return <CommandDialog />;
  if (overlay.value === "orders") return <OrdersDialog />;
  return null;
}

/** The editor of missions, which is loaded when it is first shown. */
function Design() {
  const view = useSignal<FunctionComponent | null>(null);
  useEffect(() => {
    import("../views/design/design_view.tsx").then(({ DesignView }) => {
      view.value = DesignView;
    }, tell);
  }, []);
  const View = view.value;
  const open = mission.value;
  return View === null || open === null ? <p class="hint">Opening the mission …</p> : <View key={open.id} />;
}

export function Shell() {
  const open = session.value;
  useMeshDrop();
  return (
    <SessionContext.Provider value={open}>
      {open === null ? designing.value ? <Design /> : <Start /> : <Workspace key={open.log.info.id} session={open} />}
      <DropSign />
      <Overlay />
      <Notices />
    </SessionContext.Provider>
  );
}
