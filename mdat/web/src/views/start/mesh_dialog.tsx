// A new mission for a mesh: its file, its name and scale, and the command that does the same.
import { type Signal, useComputed, useSignal } from "@preact/signals";
import { useEffect, useLayoutEffect, useRef } from "preact/hooks";
import { ApiError } from "../../api/client.ts";
import { overlay } from "../../app/overlay.ts";
import { routeToMission } from "../../app/route.ts";
import { beginMission, begun, folderName, MESH_ENDINGS, mesh, newCommand } from "../../design/mesh.ts";
import { bytesText } from "../../maths/scales.ts";
import { CommandText } from "../../parts/controls.tsx";
import { Dialog } from "../../parts/dialog.tsx";
import { Icon } from "../../parts/icon.tsx";

/** A file that was dropped, as if the button had chosen it. */
function show(file: File | null, input: HTMLInputElement | null): void {
  if (file === null || input === null || input.files?.[0] === file) return;
  const transfer = new DataTransfer();
  transfer.items.add(file);
  input.files = transfer.files;
}

function FileChoice() {
  const file = mesh.value;
  const input = useRef<HTMLInputElement>(null);
  useLayoutEffect(() => show(file, input.current), [file]);
  return (
    <label class="mesh-file">
      <span>Mesh</span>
      <input
        ref={input}
        type="file"
        accept={MESH_ENDINGS}
        onChange={(event) => {
          mesh.value = event.currentTarget.files?.[0] ?? mesh.peek();
        }}
      />
      <small>{file === null ? "STL, OBJ, PLY, glTF, or a parametric model" : bytesText(file.size)}</small>
    </label>
  );
}

function Entry({ label, help, value }: { label: string; help: string; value: Signal<string> }) {
  return (
    <label>
      <span>{label}</span>
      <input
        value={value.value}
        spellcheck={false}
        onInput={(event) => {
          value.value = event.currentTarget.value;
        }}
      />
      <small>{help}</small>
    </label>
  );
}

/** Making takes as long as the model's compilation: the refusal of it stays in the dialog, with all that was chosen. */
function useMaking(wish: { name: Signal<string>; scale: Signal<string>; triangles: Signal<string> }) {
  const busy = useSignal(false);
  const refusal = useSignal<ApiError | null>(null);
  const make = async (event: Event) => {
    event.preventDefault();
    const file = mesh.peek();
    if (file === null || busy.peek()) return;
    busy.value = true;
    refusal.value = null;
    try {
      const made = await beginMission(file, { name: wish.name.value.trim(), scale: wish.scale.value, triangles: wish.triangles.value });
      begun.value = made;
      // Who closed the dialog meanwhile finds the mission in the list.
      if (overlay.peek() === "mesh") location.hash = routeToMission(made.id);
      overlay.value = null;
    } catch (error) {
      refusal.value = error instanceof ApiError ? error : new ApiError(String(error), "Choose the file again.", 0);
    }
    busy.value = false;
  };
  return { busy, refusal, make };
}

export function MeshDialog() {
  const file = mesh.value;
  const name = useSignal("");
  const scale = useSignal("1");
  const triangles = useSignal("");
  const { busy, refusal, make } = useMaking({ name, scale, triangles });
  const command = useComputed(() =>
    newCommand(mesh.value?.name ?? "", { name: name.value, scale: scale.value, triangles: triangles.value }),
  );
  useEffect(() => {
    if (file !== null) name.value = folderName(file.name);
    refusal.value = null;
  }, [file]);
  return (
    <Dialog title="A new mission for a mesh">
      <form class="mesh-form" onSubmit={make}>
        <FileChoice />
        <Entry label="Name" help="of a new folder, and of the mission in it" value={name} />
        <Entry label="Scale" help="the file's lengths times this are metres: 0.001 for millimetres" value={scale} />
        <Entry label="Triangles" help="of a coarser mesh to fly with; empty: the mesh as it is" value={triangles} />
        {refusal.value === null ? null : (
          <p class="bad" role="alert">
            <Icon name="error" />
            <span>
              <strong>{refusal.value.message}</strong> {refusal.value.remedy}
            </span>
          </p>
        )}
        <p>
          <button type="submit" class="primary" disabled={file === null || name.value === "" || busy.value}>
            Make the mission
          </button>{" "}
          <span role="status">{busy.value ? `${file?.name ?? "The mesh"} is measured, and its model compiled …` : ""}</span>
        </p>
      </form>
      <p class="same">The same from the command line:</p>
      <CommandText text={command.value} label="command of the new mission" />
    </Dialog>
  );
}
