// A mesh that is dropped anywhere on the page becomes a new mission, after a look at its name and scale.
import { signal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { remark } from "../../app/notices.ts";
import { chooseMesh } from "../../design/mesh.ts";
import { live } from "../../live/feed.ts";
import { Icon } from "../../parts/icon.tsx";

const over = signal(false);

const holdsFiles = (event: DragEvent): boolean => live.peek() !== null && (event.dataTransfer?.types.includes("Files") ?? false);

function onOver(event: DragEvent): void {
  if (!holdsFiles(event)) return;
  event.preventDefault();
  over.value = true;
}

/** Only when the pointer leaves the window: between elements it is still over the page. */
function onLeave(event: DragEvent): void {
  if (event.relatedTarget === null) over.value = false;
}

function onDrop(event: DragEvent): void {
  over.value = false;
  if (!holdsFiles(event)) return;
  event.preventDefault();
  const files = event.dataTransfer!.files;
  if (files.length > 1) remark(`One file at a time: ${files[0].name} is taken.`);
  if (files.length > 0) chooseMesh(files[0]);
}

export function useMeshDrop(): void {
  useEffect(() => {
    const listeners = { dragover: onOver, dragleave: onLeave, drop: onDrop };
    for (const [name, act] of Object.entries(listeners)) window.addEventListener(name, act as EventListener);
    return () => {
      for (const [name, act] of Object.entries(listeners)) window.removeEventListener(name, act as EventListener);
    };
  }, []);
}

export function DropSign() {
  if (!over.value) return null;
  return (
    <div class="drop-sign" aria-hidden="true">
      <p>
        <Icon name="add" /> Drop the mesh: a new mission is made for it.
      </p>
    </div>
  );
}
