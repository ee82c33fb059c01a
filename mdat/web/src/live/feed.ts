// What the server flies, as it tells it over a socket, and what it can be told. Frames are asked for as those of any recording (follow.ts).
import { type Signal, signal } from "@preact/signals";
import { getJson, postJson } from "../api/client.ts";
import type { About, LiveState } from "../api/types.ts";
import { remark, tell } from "../app/notices.ts";

const AGAIN_MS = 1000;

/** Paces that are offered: seconds of the run in one of the clock; 0 is as fast as it goes. */
export const PACES: readonly number[] = [0.1, 0.25, 0.5, 1, 2, 4, 8, 16, 0];

export function paceText(pace: number): string {
  return pace === 0 ? "no limit" : `${pace} ×`;
}

/** The next pace of the list: the unlimited one is the fastest. */
export function nextPace(pace: number, steps: 1 | -1): number {
  const at = PACES.indexOf(pace);
  return PACES[Math.min(PACES.length - 1, Math.max(0, (at < 0 ? 3 : at) + steps))];
}

/** The state that was told last; null where the server flies nothing at all. */
export const live: Signal<LiveState | null> = signal(null);
/** False while the server's socket is lost. */
export const connected: Signal<boolean> = signal(true);
/** When the state was told, on the page's own clock. */
let told_ms = 0;

export function isUnderWay(state: LiveState | null): boolean {
  return state?.phase === "preparing" || state?.phase === "running";
}

/** True of the recording that a run is writing now. */
export function isLive(recording: string): boolean {
  const state = live.peek();
  return state?.phase === "running" && state.id === recording;
}

function take(state: LiveState): void {
  told_ms = performance.now();
  connected.value = true;
  live.value = state;
}

/** Seconds since the last packet, by the page's clock; null: there was none. */
export function age_s(state: LiveState): number | null {
  return state.age_s === null ? null : state.age_s + (performance.now() - told_ms) / 1000;
}

function listen(): void {
  const socket = new WebSocket(`ws://${location.host}/api/live/socket`);
  socket.addEventListener("message", (event) => take(JSON.parse(String(event.data)) as LiveState));
  socket.addEventListener("close", () => {
    connected.value = false;
    setTimeout(listen, AGAIN_MS);
  });
}

/** Asks once for the state, and then hears each change. A server that flies nothing is not listened to. */
export async function startFeed(): Promise<void> {
  const about = await getJson<About>("/api/about");
  if (!about.features.includes("live")) return;
  take(await getJson<LiveState>("/api/live"));
  listen();
}

/** The answer is not shown: the socket may have told a later state before it came. Null where it was refused, which is told. */
async function act(what: string, body: object = {}): Promise<LiveState | null> {
  try {
    return await postJson<LiveState>(`/api/live/${what}`, body);
  } catch (error) {
    tell(error);
    return null;
  }
}

export interface RunOrder {
  mission: string;
  scenario: string;
  seed: number | null;
  pace: number;
}

export interface CommandOrder {
  name: string;
  values: Record<string, string>;
  arm?: boolean;
}

/** Of a component nothing is paced from here: it says so in place of acting. */
function pace(act_: () => Promise<LiveState | null>): Promise<LiveState | null> {
  if ((live.peek()?.address ?? null) === null) return act_();
  remark("A component keeps its own pace. The arrow to the left looks back.");
  return Promise.resolve(null);
}

export const startRun = (order: RunOrder): Promise<LiveState | null> => act("start", order);
/** An empty mission: it is not known what flies. */
export const connectTo = (address: string, mission: string): Promise<LiveState | null> => act("connect", { address, mission });
export const giveCommand = (order: CommandOrder): Promise<LiveState | null> => act("command", order);
export const stopRun = (): Promise<LiveState | null> => act("stop");
export const stepRun = (): Promise<LiveState | null> => pace(() => act("step"));
export const setPace = (next: number): Promise<LiveState | null> => pace(() => act("pace", { pace: next }));
export const toggleRun = (): Promise<LiveState | null> => pace(() => act(live.peek()?.paused === true ? "resume" : "pause"));
export const changePace = (steps: 1 | -1): Promise<LiveState | null> => setPace(nextPace(live.peek()?.pace ?? 1, steps));
