// The first visit: the server flies the tenth-scale Hubble and records it; then the recording is opened and played.
import { type Signal, signal } from "@preact/signals";
import { getJson, postJson } from "../../api/client.ts";
import type { Job } from "../../api/types.ts";
import { tell } from "../../app/notices.ts";
import { routeTo } from "../../app/route.ts";

const POLL_MS = 250;

/** Progress of the recording in the making; null while none is made. */
export const making: Signal<Job | null> = signal(null);

const pause = (ms: number) => new Promise((resolve) => setTimeout(resolve, ms));

async function finished(job: string): Promise<string> {
  for (;;) {
    const progress = await getJson<Job>(`/api/jobs/${encodeURIComponent(job)}`);
    making.value = progress;
    if (progress.error !== undefined) throw new Error(progress.error);
    if (progress.id !== undefined) return progress.id;
    await pause(POLL_MS);
  }
}

/** Makes the first recording, or takes the one that is there, and plays it. */
export async function makeFirst(): Promise<void> {
  if (making.peek() !== null) return;
  making.value = { done: 0, text: "Starting" };
  try {
    const { job, id } = await postJson<{ job?: string; id?: string }>("/api/recordings/first");
    const recording = job === undefined ? id : await finished(job);
    if (recording === undefined) throw new Error("The server named neither a recording nor a job.");
    location.hash = `${routeTo(recording)}?play`;
  } catch (error) {
    tell(error);
  } finally {
    making.value = null;
  }
}
