// The bar of a live run: what it does, what it can be told, how well its frames come, and the way back to now.
import { useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import type { LiveState } from "../../api/types.ts";
import { openOverlay } from "../../app/overlay.ts";
import { routeTo } from "../../app/route.ts";
import type { Session } from "../../app/session.ts";
import { age_s, connected, live, nextPace, PACES, paceText, setPace, stepRun, stopRun, toggleRun } from "../../live/feed.ts";
import { IconButton } from "../../parts/controls.tsx";
import { Icon } from "../../parts/icon.tsx";
import { ageText, isStale, packetsText, staleText } from "./health.ts";

const LOOK_MS = 500;

/** The age of the newest frame; looked at again while frames should come, and not otherwise. */
function useAge(state: LiveState): number | null {
  const age = useSignal(age_s(state));
  const looks = state.phase === "running" && !state.paused;
  useEffect(() => {
    age.value = age_s(state);
    if (!looks) return undefined;
    const timer = setInterval(() => {
      age.value = age_s(state);
    }, LOOK_MS);
    return () => clearInterval(timer);
  }, [state, looks]);
  return age.value;
}

export function PaceChoice({ pace, onChoose }: { pace: number; onChoose: (pace: number) => void }) {
  const offered = PACES.includes(pace) ? PACES : [pace, ...PACES];
  return (
    <select
      aria-label="Pace of the run"
      title="Seconds of the run in one of the clock (, and .)"
      value={pace}
      onChange={(event) => onChoose(Number(event.currentTarget.value))}
    >
      {offered.map((each) => (
        <option key={each} value={each}>
          {paceText(each)}
        </option>
      ))}
    </select>
  );
}

function Controls({ state }: { state: LiveState }) {
  return (
    <div class="live-controls" role="group" aria-label="The run">
      <button type="button" class="text-button" title={`${state.paused ? "Go on" : "Pause"} (Space)`} onClick={toggleRun}>
        <Icon name={state.paused ? "play" : "pause"} /> {state.paused ? "Go on" : "Pause"}
      </button>
      <IconButton icon="stepForward" label="Fly one frame" stroke="ArrowRight" onClick={stepRun} />
      <IconButton icon="slower" label="Slower" stroke="," onClick={() => setPace(nextPace(state.pace, -1))} />
      <PaceChoice pace={state.pace} onChoose={setPace} />
      <IconButton icon="faster" label="Faster" stroke="." onClick={() => setPace(nextPace(state.pace, 1))} />
      <button type="button" class="text-button" title="End the run; what it recorded stays" onClick={stopRun}>
        <Icon name="stop" /> Stop
      </button>
    </div>
  );
}

/** A component elsewhere keeps its own pace: it is commanded, and let go. */
function LinkControls({ state }: { state: LiveState }) {
  return (
    <div class="live-controls" role="group" aria-label="The component">
      <span class="live-address">{state.address}</span>
      <button type="button" class="text-button" onClick={() => openOverlay("orders")}>
        <Icon name="command" /> Commands
      </button>
      <button
        type="button"
        class="text-button"
        title="End the connection; what was recorded stays, and the component goes on"
        onClick={stopRun}
      >
        <Icon name="stop" /> Disconnect
      </button>
    </div>
  );
}

function Stale({ state, age }: { state: LiveState; age: number | null }) {
  const lost = !connected.value;
  return (
    <div class="banner banner-stale" role="alert">
      <Icon name="warning" />
      <span>
        <strong>The data are stale.</strong>{" "}
        {lost ? "The server does not answer: see whether mdat serve still runs. It is asked again every second." : staleText(state, age)}
      </span>
    </div>
  );
}

function Running({ session, state }: { session: Session; state: LiveState }) {
  const age = useAge(state);
  const { selection, log, player } = session;
  const follows = selection.following.value;
  return (
    <>
      <section class="live-bar" aria-label="Live">
        <span class={`live-mark${state.paused ? " paused" : ""}`}>{state.paused ? "Paused" : "Live"}</span>
        {state.address === null ? <Controls state={state} /> : <LinkControls state={state} />}
        <span class="live-count">{state.address === null ? `${log.frames} of ${state.frames} frames` : `${log.frames} frames`}</span>
        <span class="live-health" title="Packets of telemetry, gaps in their counts, and the newest one's age">
          {packetsText(state)}, {ageText(age)}
        </span>
        {follows ? (
          <span class="live-now">following the newest frame</span>
        ) : (
          <button
            type="button"
            class="text-button live-now"
            title="Follow the newest frame (End)"
            onClick={() => player.goTo(log.frames - 1)}
          >
            <Icon name="last" /> Back to now
          </button>
        )}
      </section>
      {!connected.value || isStale(state, age) ? <Stale state={state} age={age} /> : null}
    </>
  );
}

function endText(state: LiveState, failed: boolean): string {
  if (state.address !== null) return failed ? "The connection failed." : "The connection has ended.";
  return failed ? "The run failed." : "The run is over.";
}

/** A component that was reset: its clock began anew, and so did its recording. */
function Anew({ state }: { state: LiveState }) {
  return (
    <div class="banner" role="alert">
      <Icon name="warning" />
      <span>
        <strong>The component's clock began anew.</strong> Its telemetry goes on in a further recording:{" "}
        <a href={routeTo(state.id)}>{state.name}</a>.
      </span>
    </div>
  );
}

/** The end of a run that was watched here. */
function Ended({ state, onClose }: { state: LiveState; onClose: () => void }) {
  const failed = state.phase === "failed";
  return (
    <div class={`banner${failed ? "" : " banner-over"}`} role="status">
      <Icon name={failed ? "error" : "check"} />
      <span>
        <strong>{endText(state, failed)}</strong> {failed ? `${state.error ?? ""}. ` : ""}Its recording is {state.name}, and is in the list.
      </span>
      <IconButton icon="close" label="Close the message about the run" onClick={onClose} />
    </div>
  );
}

export function LiveBar({ session }: { session: Session }) {
  const watched = useSignal(session.log.live.peek());
  const state = live.value;
  if (session.log.live.value) watched.value = true;
  if (state === null) return null;
  if (state.id !== session.log.info.id) return session.log.live.value && state.phase === "running" ? <Anew state={state} /> : null;
  if (session.log.live.value) return <Running session={session} state={state} />;
  const close = () => {
    watched.value = false;
  };
  return watched.value && (state.phase === "over" || state.phase === "failed") ? <Ended state={state} onClose={close} /> : null;
}
