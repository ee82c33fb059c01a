// The series of a plot for the window that is shown, and statistics of the span; asked anew a moment after they changed.
import { type Signal, useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import type { Series } from "../../api/decode.ts";
import type { Statistics } from "../../api/types.ts";
import { tell } from "../../app/notices.ts";
import type { Log } from "../../log/log.ts";
import type { Span } from "../../log/selection.ts";

const WAIT_MS = 60;
/** Plots of a live run are drawn anew this much later, with all that came meanwhile. */
const GROWTH_MS = 300;

/** Runs `ask` a moment after its inputs have settled, and gives up what was asked before; also when the log has grown, once at a time. */
function useSettled(log: Log, ask: (signal: AbortSignal) => Promise<void>, inputs: unknown[], wait_ms: number): void {
  const current = useRef<AbortController | null>(null);
  const busy = useRef(false);
  useEffect(() => {
    const abort = new AbortController();
    current.current = abort;
    const timer = setTimeout(() => ask(abort.signal).catch(tell), wait_ms);
    return () => {
      clearTimeout(timer);
      abort.abort();
    };
  }, inputs);
  const frames = log.frames;
  useEffect(() => {
    if (!log.live.peek() || busy.current || current.current === null) return;
    busy.current = true;
    const signal = current.current.signal;
    setTimeout(() => {
      const free = () => {
        busy.current = false;
      };
      ask(signal).catch(tell).finally(free);
    }, GROWTH_MS);
  }, [frames]);
}

export function useSeries(log: Log, values: string[], window: Span, points: number): Signal<Series[] | null> {
  const series = useSignal<Series[] | null>(null);
  const ask = async (signal: AbortSignal) => {
    if (points < 10) return;
    series.value = await Promise.all(values.map((value) => log.series(value, window.from_s, window.to_s, points, signal)));
  };
  useSettled(log, ask, [log, values.join(), window.from_s, window.to_s, points], series.peek() === null ? 0 : WAIT_MS);
  return series;
}

export function useStatistics(log: Log, values: string[], range: Span): Signal<Map<string, Statistics>> {
  const statistics = useSignal(new Map<string, Statistics>());
  const ask = async (signal: AbortSignal) => {
    const found = await Promise.all(values.map((value) => log.statistics(value, range.from_s, range.to_s, signal)));
    statistics.value = new Map(values.map((value, i) => [value, found[i]]));
  };
  useSettled(log, ask, [log, values.join(), range.from_s, range.to_s], 2 * WAIT_MS);
  return statistics;
}
