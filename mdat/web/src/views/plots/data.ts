// A plot's data as uPlot wants it: one axis of time, and for each value the last, least and largest of each bin; gaps are null.
import type { Series } from "../../api/decode.ts";

export type Column = (number | null)[];
export type PlotData = [number[], ...Column[]];

const orNull = (x: number): number | null => (Number.isFinite(x) ? x : null);

/** The sorted times of all series, each once. */
function mergedTimes(series: Series[]): number[] {
  const all = series.flatMap((each) => Array.from(each.time_s));
  all.sort((a, b) => a - b);
  return all.filter((time, i) => i === 0 || time !== all[i - 1]);
}

function columnOn(times: number[], series: Series, values: Float32Array): (number | null | undefined)[] {
  let at = 0;
  return times.map((time) => {
    if (at >= series.time_s.length || series.time_s[at] !== time) return undefined;
    return orNull(values[at++]);
  });
}

/** Columns in the order time, then last, min, max of each series. Times of other series are undefined: the line goes on across them. */
export function plotData(series: Series[]): PlotData {
  const times = mergedTimes(series);
  const columns = series.flatMap((each) => [each.last, each.min, each.max].map((values) => columnOn(times, each, values)));
  return [times, ...(columns as Column[])];
}

/** Whether any value is there to be drawn. */
export const hasValues = ([, ...columns]: PlotData): boolean => columns.some((column) => column.some((x) => Number.isFinite(x)));

/** The value at the last time that is not after `time_s`; null where there is none. */
export function valueAt(series: Series, time_s: number): number | null {
  let low = 0;
  let high = series.time_s.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (series.time_s[middle] <= time_s) low = middle + 1;
    else high = middle;
  }
  return low === 0 ? null : orNull(series.last[low - 1]);
}

/** The time of the largest value, NaN where there is none. */
export function timeOfLargest(series: Series): number {
  let best = -1;
  for (let i = 0; i < series.max.length; ++i)
    if (Number.isFinite(series.max[i]) && (best < 0 || series.max[i] > series.max[best])) best = i;
  return best < 0 ? Number.NaN : series.time_s[best];
}

/** At most `most` rows, evenly thinned, for a table that people read. */
export function thinned(count: number, most: number): number[] {
  if (count <= most) return Array.from({ length: count }, (_, i) => i);
  return Array.from({ length: most }, (_, i) => Math.round((i * (count - 1)) / (most - 1)));
}
