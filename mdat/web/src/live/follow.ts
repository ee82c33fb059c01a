// Lets the opened recording grow while the server's run writes it: at most one question at a time, and none while nothing is new.
import { effect } from "@preact/signals";
import type { LiveState } from "../api/types.ts";
import { tell } from "../app/notices.ts";
import { type Session, session } from "../app/session.ts";
import { live } from "./feed.ts";

const LEAST_MS = 120;
/** Kinds of telemetry come one after the other in the first frames: until then the values are asked for again. */
const FIRST_FRAMES = 12;

let busy = false;
let again = false;

const pause = (ms: number) => new Promise((resolve) => setTimeout(resolve, ms));

async function grow(open: Session, over: boolean): Promise<void> {
  const { log, selection, events } = open;
  const more = await log.more();
  if (over || log.frames < FIRST_FRAMES) await log.askAgain();
  selection.grow(() => {
    if (more !== null) log.append(more);
    if (over) log.live.value = false;
  });
  if (over) selection.following.value = false;
  await events.more(log);
}

/** True of a state after which the recording is not as it is shown. */
function concerns(open: Session, state: LiveState): boolean {
  return open.log.live.peek() && state.id === open.log.info.id;
}

async function follow(): Promise<void> {
  if (busy) {
    again = true;
    return;
  }
  busy = true;
  try {
    do {
      again = false;
      const open = session.peek();
      const state = live.peek();
      if (open === null || state === null || !concerns(open, state)) break;
      await grow(open, state.phase !== "running");
      await pause(LEAST_MS);
    } while (again);
  } catch (error) {
    tell(error);
  } finally {
    busy = false;
  }
}

export function startFollowing(): void {
  effect(() => {
    if (live.value !== null && session.value !== null) follow();
  });
}
