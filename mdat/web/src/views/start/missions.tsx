// On the start page: the missions that can be looked at and designed.
import { useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { getJson } from "../../api/client.ts";
import type { LiveMission } from "../../api/types.ts";
import { tell } from "../../app/notices.ts";
import { routeToMission } from "../../app/route.ts";
import { live } from "../../live/feed.ts";
import { CommandText } from "../../parts/controls.tsx";

export function Missions() {
  const missions = useSignal<LiveMission[]>([]);
  const there = live.value !== null;
  useEffect(() => {
    if (!there) return;
    getJson<LiveMission[]>("/api/live/missions").then((answer) => (missions.value = answer), tell);
  }, [there]);
  if (missions.value.length === 0) return null;
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
      <p class="same">A new one for a mesh of yours, from the command line; it then stands in this list:</p>
      <CommandText text="mdat mission new --model target.stl --scale 1 --out target.toml" label="command of a new mission" />
    </section>
  );
}
