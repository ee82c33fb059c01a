// On the start page: the missions that can be looked at and designed.
import { useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { getJson } from "../../api/client.ts";
import type { LiveMission } from "../../api/types.ts";
import { tell } from "../../app/notices.ts";
import { routeToMission } from "../../app/route.ts";
import { chooseMesh } from "../../design/mesh.ts";
import { live } from "../../live/feed.ts";
import { CommandText } from "../../parts/controls.tsx";
import { Icon } from "../../parts/icon.tsx";

export function Missions() {
  const missions = useSignal<LiveMission[]>([]);
  const there = live.value !== null;
  useEffect(() => {
    if (!there) return;
    getJson<LiveMission[]>("/api/live/missions").then((answer) => (missions.value = answer), tell);
  }, [there]);
  if (!there) return null;
  return (
    <section aria-label="Design">
      <h2>Design a mission</h2>
      <ul class="mission-list">
        {missions.value.map(({ id, shipped }) => (
          <li key={id}>
            <a href={routeToMission(id)}>{id}</a> {shipped ? null : <small>own</small>}
          </li>
        ))}
      </ul>
      <p>
        <button type="button" class="text-button" onClick={() => chooseMesh(null)}>
          <Icon name="add" /> New for a mesh …
        </button>{" "}
        or drop the mesh of your target on this page: STL, OBJ, PLY or glTF.
      </p>
      <p class="same">The same from the command line; the mission then stands in this list:</p>
      <CommandText text="mdat mission new --model target.stl --scale 1 --out target.toml" label="command of a new mission" />
    </section>
  );
}
