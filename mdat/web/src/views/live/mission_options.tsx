// The missions of the list as options of a select.
import type { LiveMission } from "../../api/types.ts";

export function MissionOptions({ missions }: { missions: LiveMission[] }) {
  return (
    <>
      {missions.map(({ id, shipped }) => (
        <option key={id} value={id}>
          {shipped ? id : `${id} (own)`}
        </option>
      ))}
    </>
  );
}
