// What would be written, line by line, before it is.
import { useLayoutEffect, useRef } from "preact/hooks";
import { changedLines } from "../../design/lines.ts";
import type { Mission } from "../../design/mission.ts";
import { IconButton } from "../../parts/controls.tsx";

export function SaveDialog({ mission, onClose }: { mission: Mission; onClose: () => void }) {
  const dialog = useRef<HTMLDialogElement>(null);
  useLayoutEffect(() => dialog.current?.showModal(), []);
  const save = async () => {
    await mission.save();
    onClose();
  };
  return (
    <dialog ref={dialog} class="dialog" aria-label="Save the mission" onClose={onClose}>
      <header>
        <h2>Save {mission.id}</h2>
        <IconButton icon="close" label="Close" stroke="Escape" onClick={onClose} />
      </header>
      <div class="dialog-body" tabIndex={0}>
        <table class="table line-changes">
          <caption>Lines that change</caption>
          <tbody>
            {changedLines(mission.saved.value, mission.text.value).map(({ sign, line, text }) => (
              <tr key={`${sign}${line}`} class={sign === "+" ? "added" : "removed"}>
                <td class="number">{line}</td>
                <td>
                  <code>
                    {sign} {text}
                  </code>
                </td>
              </tr>
            ))}
          </tbody>
        </table>
        <p>
          <button type="button" class="primary" onClick={save}>
            Save
          </button>
        </p>
      </div>
    </dialog>
  );
}
