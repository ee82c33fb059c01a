// How well the frames of a live run come, in words.
import type { LiveState } from "../../api/types.ts";
import { countText } from "../../maths/scales.ts";

/** The scanners' frames come five times a second. */
const FRAME_S = 0.2;
const LEAST_STALE_S = 3;
const FRAMES_STALE = 5;

/** True where packets should come and have not for long: at a slow pace they come seldom. */
export function isStale(state: LiveState, age_s: number | null): boolean {
  if (state.phase !== "running" || state.paused) return false;
  if (state.trouble) return true;
  if (age_s === null) return false;
  const period_s = state.pace > 0 ? FRAME_S / state.pace : FRAME_S;
  return age_s > Math.max(LEAST_STALE_S, FRAMES_STALE * period_s);
}

export function ageText(age_s: number | null): string {
  if (age_s === null) return "no frame yet";
  return age_s < 1 ? "last frame less than 1 s ago" : `last frame ${Math.floor(age_s)} s ago`;
}

export function packetsText(state: LiveState): string {
  const missing = state.missing === 0 ? "none missing" : `${countText(state.missing)} missing`;
  const others = state.other_bytes > 0 ? `, ${countText(state.other_bytes)} bytes of none` : "";
  return `${state.rate_per_s.toFixed(1)} packets/s, ${missing}${others}`;
}

/** What helps where nothing comes. */
export function staleText(state: LiveState, age_s: number | null): string {
  if (state.trouble) return `${state.trouble}. It is tried again every second.`;
  const silence = `No packet has come for ${Math.floor(age_s ?? 0)} s.`;
  if (state.address !== null) return `${silence} See whether the component runs, and whether somebody else has its link.`;
  return `${silence} The machine may be busy: a slower pace helps, or stop the run.`;
}
