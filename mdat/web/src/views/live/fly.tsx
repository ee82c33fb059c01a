// On the start page: what to fly live, and what flies.
import { type Signal, useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { getJson, withQuery } from "../../api/client.ts";
import type { LiveMission, LiveScenario, LiveState } from "../../api/types.ts";
import { tell } from "../../app/notices.ts";
import { routeTo } from "../../app/route.ts";
import { connectTo, isUnderWay, live, startRun, stopRun } from "../../live/feed.ts";
import { CommandText, Empty } from "../../parts/controls.tsx";
import { Icon } from "../../parts/icon.tsx";
import { commandOf, firstMission, firstScenario, seedOf } from "./choice.ts";
import { Connect } from "./connect.tsx";
import { PaceChoice } from "./live_bar.tsx";
import { MissionOptions } from "./mission_options.tsx";

/** The recording that this page has asked for: it is opened once it has a frame. */
const wanted: { id: string | null } = { id: null };

function openWanted(state: LiveState): void {
  if (wanted.id !== state.id || state.phase === "preparing" || state.bytes === 0 || state.boundaries < 2) return;
  wanted.id = null;
  location.hash = routeTo(state.id);
}

async function begin(asked: Promise<LiveState | null>): Promise<void> {
  const begun = await asked;
  if (begun === null) return;
  wanted.id = begun.id;
  const state = live.peek();
  if (state !== null) openWanted(state);
}

function useScenarios(mission: string): Signal<LiveScenario[] | null> {
  const scenarios = useSignal<LiveScenario[] | null>(null);
  useEffect(() => {
    if (mission === "") return undefined;
    const abort = new AbortController();
    scenarios.value = null;
    getJson<{ scenarios: LiveScenario[] }>(withQuery("/api/live/scenarios", { mission }), abort.signal).then((answer) => {
      scenarios.value = answer.scenarios;
    }, tell);
    return () => abort.abort();
  }, [mission]);
  return scenarios;
}

function scenarioText({ name, frames, runs }: LiveScenario): string {
  return runs === 1 ? `${name} (${frames} frames)` : `${name} (${runs} ranges: mdat run alone)`;
}

function Form({ missions }: { missions: LiveMission[] }) {
  const mission = useSignal(firstMission(missions));
  const chosen = useSignal<string | null>(null);
  const seedText = useSignal("");
  const pace = useSignal(1);
  const scenarios = useScenarios(mission.value).value;
  const scenario = chosen.value ?? (scenarios === null ? "" : firstScenario(scenarios));
  const seed = seedOf(seedText.value);
  const entry = missions.find((each) => each.id === mission.value);
  const own = scenarios?.find((each) => each.name === scenario);
  const ready = scenario !== "" && seed !== undefined;
  const submit = (event: Event) => {
    event.preventDefault();
    if (ready) begin(startRun({ mission: mission.value, scenario, seed: seed ?? null, pace: pace.value }));
  };
  return (
    <form class="fly" aria-label="Fly live" onSubmit={submit}>
      <div class="fly-fields">
        <label>
          Mission
          <select
            value={mission.value}
            onChange={(event) => {
              chosen.value = null;
              mission.value = event.currentTarget.value;
            }}
          >
            <MissionOptions missions={missions} />
          </select>
        </label>
        <label>
          Scenario
          <select
            value={scenario}
            disabled={scenarios === null}
            onChange={(event) => {
              chosen.value = event.currentTarget.value;
            }}
          >
            {(scenarios ?? []).map((each) => (
              <option key={each.name} value={each.name} disabled={each.runs !== 1}>
                {scenarioText(each)}
              </option>
            ))}
          </select>
        </label>
        <label>
          Seed
          <input
            inputMode="numeric"
            placeholder={own === undefined ? "" : `${own.seed} (the scenario's)`}
            value={seedText.value}
            aria-invalid={seed === undefined}
            onInput={(event) => {
              seedText.value = event.currentTarget.value;
            }}
          />
        </label>
        <div class="field">
          <span>Pace</span>
          <PaceChoice
            pace={pace.value}
            onChoose={(next) => {
              pace.value = next;
            }}
          />
        </div>
        <button type="submit" class="primary" disabled={!ready}>
          <Icon name="play" /> Fly live
        </button>
      </div>
      {seed === undefined ? (
        <p role="alert">The seed is a whole number from 0 to 4294967295. Leave it empty for the scenario's own.</p>
      ) : null}
      {scenarios !== null && scenario === "" ? (
        <p role="status">No scenario of this mission has one run alone: choose another mission.</p>
      ) : null}
      {entry === undefined || scenario === "" ? null : (
        <div>
          <p class="same">The same from the command line, watched in Lichtblick or Foxglove:</p>
          <CommandText text={commandOf(entry, scenario, seed ?? null, pace.value)} label="command of the live run" />
        </div>
      )}
    </form>
  );
}

/** What it is, and how far. */
function progressText(state: LiveState): string {
  if (state.address === null)
    return state.phase === "preparing"
      ? "is being prepared: its model is compiled …"
      : `flies: frame ${state.boundaries} of ${state.frames}.`;
  if (state.phase === "preparing") return "is being connected …";
  if (state.trouble) return `is lost: ${state.trouble}. It is tried again every second.`;
  if (state.packets === 0) return "is connected, and nothing has come yet: see whether the component runs, and sends to this machine.";
  return `is connected: ${state.boundaries} frames so far.`;
}

function UnderWay({ state }: { state: LiveState }) {
  return (
    <div class="fly" role="status">
      <p>
        <strong>{state.address ?? `${state.mission}, ${state.scenario}`}</strong> {progressText(state)}
      </p>
      <div class="fly-fields">
        {state.phase === "running" && state.bytes > 0 ? (
          <a class="text-button" href={routeTo(state.id)}>
            <Icon name="play" /> Watch
          </a>
        ) : null}
        <button type="button" class="text-button" onClick={stopRun}>
          <Icon name="stop" /> {state.address === null ? "Stop" : "Disconnect"}
        </button>
      </div>
      <CommandText text={state.command} label="command of the live run" />
    </div>
  );
}

export function Fly() {
  const missions = useSignal<LiveMission[] | null>(null);
  const state = live.value;
  const there = state !== null;
  useEffect(() => {
    if (!there) return;
    getJson<LiveMission[]>("/api/live/missions").then((answer) => (missions.value = answer), tell);
  }, [there]);
  useEffect(() => {
    if (state !== null) openWanted(state);
  }, [state]);
  if (state === null) return null;
  return (
    <section aria-label="Live">
      <h2>Live</h2>
      {state.phase === "failed" ? (
        <p class="bad" role="alert">
          <Icon name="error" />{" "}
          {state.address === null
            ? `The run of ${state.mission}, ${state.scenario}, failed: ${state.error}`
            : `No connection: ${state.error}`}
        </p>
      ) : null}
      {isUnderWay(state) ? (
        <UnderWay state={state} />
      ) : missions.value === null ? (
        <p class="hint">Looking for missions …</p>
      ) : (
        <>
          {missions.value.length === 0 ? (
            <Empty title="There is no mission here.">
              Make one with mdat mission new in the folder that mdat serve was given, and reload.
            </Empty>
          ) : (
            <Form missions={missions.value} />
          )}
          <Connect missions={missions.value} onConnect={(address, mission) => begin(connectTo(address, mission))} />
        </>
      )}
    </section>
  );
}
