// What would be written, line by line, before it is.
import { changedLines } from "../../design/lines.ts";
import type { Mission } from "../../design/mission.ts";
import { Dialog } from "../../parts/dialog.tsx";

export function SaveDialog({ mission, onClose }: { mission: Mission; onClose: () => void }) {
  const save = async () => {
    await mission.save();
    onClose();
  };
  return (
    <Dialog title={`Save ${mission.id}`} onClose={onClose}>
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
    </Dialog>
  );
}
