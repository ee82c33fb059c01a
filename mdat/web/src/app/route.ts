// Where the page is: #/ is the start, #/r/ID?frame=N an opened recording, #/m/ID a mission that is designed. The browser's back and a copied address work.

import { signal } from "@preact/signals";
import { Mission, mission } from "../design/mission.ts";
import { tell } from "./notices.ts";
import { Session, session } from "./session.ts";

export interface Route {
  recording: string | null;
  mission: string | null;
  frame: number | null;
  play: boolean;
}

export function parseRoute(hash: string): Route {
  const [path, query = ""] = hash.replace(/^#/, "").split("?");
  const match = /^\/([rm])\/([^/]+)$/.exec(path);
  if (match === null) return { recording: null, mission: null, frame: null, play: false };
  if (match[1] === "m") return { recording: null, mission: decodeURIComponent(match[2]), frame: null, play: false };
  const search = new URLSearchParams(query);
  const frame = Number.parseInt(search.get("frame") ?? "", 10);
  return { recording: decodeURIComponent(match[2]), mission: null, frame: Number.isFinite(frame) ? frame : null, play: search.has("play") };
}

export function routeTo(recording: string | null, frame?: number): string {
  if (recording === null) return "#/";
  return `#/r/${encodeURIComponent(recording)}${frame === undefined ? "" : `?frame=${frame}`}`;
}

export function routeToMission(id: string): string {
  return `#/m/${encodeURIComponent(id)}`;
}

/** True where the address is a mission's. */
export const designing = signal(false);

let asked = 0;

/** The mission of the address, with the text that is being changed if it is open already. */
async function showMission(id: string, mine: number): Promise<void> {
  const wanted = mission.peek()?.id === id ? mission.peek() : await Mission.open(id);
  if (mine === asked) mission.value = wanted;
}

async function show(route: Route): Promise<void> {
  const mine = ++asked;
  const open = session.peek();
  if (route.recording === null) {
    open?.player.pause();
    session.value = null;
    designing.value = route.mission !== null;
    if (route.mission !== null) await showMission(route.mission, mine);
    return;
  }
  const wanted = open?.log.info.id === route.recording ? open : await Session.open(route.recording);
  // Meanwhile the user may have gone elsewhere.
  if (mine !== asked) return;
  if (route.frame !== null) wanted.selection.setFrame(wanted.log.withNumber(route.frame));
  session.value = wanted;
  if (route.play) wanted.player.play(1);
}

/** Follows the address from now on. */
export function startRouting(): void {
  const follow = () =>
    show(parseRoute(location.hash)).catch((error) => {
      tell(error);
      location.hash = routeTo(null);
    });
  window.addEventListener("hashchange", follow);
  follow();
}

/** Keeps the frame in the address without an entry in the browser's history. */
export function noteFrame(recording: string, frame: number): void {
  history.replaceState(null, "", routeTo(recording, frame));
}
