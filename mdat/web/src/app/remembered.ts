// A signal whose value the browser keeps. Without storage (a private window) it works all the same, and forgets.
import { effect, type Signal, signal } from "@preact/signals";

const PREFIX = "mdat.";

function read<T>(key: string, preset: T): T {
  try {
    const text = localStorage.getItem(PREFIX + key);
    return text === null ? preset : (JSON.parse(text) as T);
  } catch {
    return preset;
  }
}

export function remembered<T>(key: string, preset: T): Signal<T> {
  const kept = signal<T>(read(key, preset));
  let first = true;
  effect(() => {
    const text = JSON.stringify(kept.value);
    if (!first)
      try {
        localStorage.setItem(PREFIX + key, text);
      } catch {
        // no storage: the value lives as long as the page
      }
    first = false;
  });
  return kept;
}
