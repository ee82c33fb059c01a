// Of a mission that was just made for a mesh: what was guessed, and the command that does the same.
import { begun } from "../../design/mesh.ts";
import type { Mission } from "../../design/mission.ts";
import { CommandText, IconButton } from "../../parts/controls.tsx";
import { Icon } from "../../parts/icon.tsx";

export function Begun({ mission }: { mission: Mission }) {
  const made = begun.value;
  if (made === null || made.id !== mission.id) return null;
  const close = () => {
    begun.value = null;
  };
  return (
    <section class="begun" aria-label="The new mission">
      <header>
        <Icon name="check" /> <strong>The mission is made, and ready to fly.</strong> What was guessed from the mesh, to be looked at:
        <IconButton icon="close" label="Close what was guessed" onClick={close} />
      </header>
      <ul>
        {made.remarks.map((remark) => (
          <li key={remark}>{remark}</li>
        ))}
      </ul>
      <CommandText text={made.command} label="command that makes this mission" />
    </section>
  );
}
