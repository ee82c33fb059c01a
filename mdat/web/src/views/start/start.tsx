// The start: the recordings of the folder, and for a first visit one that is made by a click.
import { useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { getJson } from "../../api/client.ts";
import type { About, RecordingEntry } from "../../api/types.ts";
import { CommonTools } from "../../app/common_tools.tsx";
import { tell } from "../../app/notices.ts";
import { routeTo } from "../../app/route.ts";
import { bytesText } from "../../maths/scales.ts";
import { CommandText, Empty } from "../../parts/controls.tsx";
import { Icon } from "../../parts/icon.tsx";
import { Fly } from "../live/fly.tsx";
import { makeFirst, making } from "./first.ts";
import { Missions } from "./missions.tsx";

const ROSETTE_RAYS = 1024;

/** The scan pattern of the mission that is flown: two mirrors, 19 and 12 turns a scan. */
function rosettePath(): string {
  const point = (i: number) => {
    const turn = (2 * Math.PI * i) / ROSETTE_RAYS;
    const x = Math.cos(19 * turn) + Math.cos(12 * turn);
    const y = Math.sin(19 * turn) - Math.sin(12 * turn);
    return `${(48 * x).toFixed(1)} ${(48 * y).toFixed(1)}`;
  };
  return `M${Array.from({ length: ROSETTE_RAYS + 1 }, (_, i) => point(i)).join("L")}`;
}

function Rosette() {
  return (
    <svg class="rosette" viewBox="-100 -100 200 200" role="img" aria-label="The rosette that the scanner draws on the target" fill="none">
      <path d={rosettePath()} stroke-width="0.9" />
    </svg>
  );
}

function First({ about }: { about: About | null }) {
  if (about?.first === undefined) return null;
  const job = making.value;
  return (
    <section class="first" aria-label="A first look">
      <div class="first-words">
        <h2>See the tenth-scale Hubble being tracked</h2>
        <p>The simulation flies some 30 s, records them, and plays them here.</p>
        {job === null ? (
          <button type="button" class="primary" onClick={makeFirst}>
            <Icon name="play" /> Fly and watch
          </button>
        ) : (
          <p class="progress" role="status">
            <progress aria-label="Progress of the flight" max={1} value={job.done} /> {job.text}
          </p>
        )}
        <p class="same">The same from the command line:</p>
        <CommandText text={about.first.command} label="command of the first recording" />
      </div>
      <div>
        <Rosette />
        <ol class="next-steps">
          <li>
            <strong>Play it.</strong> Space plays and stops, arrow keys go by frames.
          </li>
          <li>
            <strong>Ask why.</strong> Each frame says why its pose was taken or refused.
          </li>
          <li>
            <strong>Then your own.</strong> Record a run with <code>mdat run MISSION --record FILE.mcap</code>: it appears below.
          </li>
        </ol>
      </div>
    </section>
  );
}

/** Local date and time to the minute, in an order that sorts. */
function dateText(seconds: number): string {
  const date = new Date(1000 * seconds);
  const two = (x: number) => String(x).padStart(2, "0");
  return `${date.getFullYear()}-${two(date.getMonth() + 1)}-${two(date.getDate())} ${two(date.getHours())}:${two(date.getMinutes())}`;
}

function Row({ entry }: { entry: RecordingEntry }) {
  return (
    <tr>
      <td>
        {entry.error === undefined ? (
          <a href={routeTo(entry.id)}>{entry.name}</a>
        ) : (
          <>
            {entry.name}
            <span class="bad">
              <Icon name="error" /> {entry.error}
            </span>
          </>
        )}
      </td>
      <td class="number">{bytesText(entry.size_bytes)}</td>
      <td>{dateText(entry.modified)}</td>
    </tr>
  );
}

function Recordings({ entries, folder }: { entries: RecordingEntry[]; folder: string }) {
  if (entries.length === 0)
    return (
      <Empty title="There is no recording here yet.">
        Make one with the button above, or put .mcap files into {folder === "" ? "the folder that mdat serve was given" : folder} and
        reload.
      </Empty>
    );
  return (
    <table class="table recordings">
      <thead>
        <tr>
          <th scope="col">Recording</th>
          <th scope="col" class="number">
            Size
          </th>
          <th scope="col">Changed</th>
        </tr>
      </thead>
      <tbody>
        {entries.map((entry) => (
          <Row key={entry.id} entry={entry} />
        ))}
      </tbody>
    </table>
  );
}

export function Start() {
  const about = useSignal<About | null>(null);
  const entries = useSignal<RecordingEntry[] | null>(null);
  useEffect(() => {
    document.title = "MDAT";
    getJson<About>("/api/about").then((answer) => (about.value = answer), tell);
    getJson<RecordingEntry[]>("/api/recordings").then((answer) => (entries.value = answer), tell);
  }, []);
  return (
    <div class="start">
      <header class="head">
        <span class="brand">
          <Icon name="home" />
          <span>MDAT</span>
        </span>
        <p class="run">Mission design and analysis tool of 3DLASSO {about.value?.version ?? ""}</p>
        <div class="head-tools">
          <CommonTools />
        </div>
      </header>
      <main class="start-body" data-view="start">
        <h1>Fly and replay</h1>
        <First about={about.value} />
        <section aria-label="Recordings">
          <h2>Recordings {about.value?.folder ? <small>in {about.value.folder}</small> : null}</h2>
          {entries.value === null ? (
            <p class="hint">Reading the folder …</p>
          ) : (
            <Recordings entries={entries.value} folder={about.value?.folder ?? ""} />
          )}
        </section>
        <Fly />
        <Missions />
      </main>
    </div>
  );
}
