// Searches in columns of frames, which are sorted by time and number.

/** The last index of an ascending column whose value is not above `limit`; 0 where there is none. */
export function lastNotAbove(column: Float64Array | Float32Array, limit: number): number {
  let low = 0;
  let high = column.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (column[middle] <= limit) low = middle + 1;
    else high = middle;
  }
  return Math.max(0, low - 1);
}

/** The next index from `from` in `direction` (1 or -1) that fits, without `from` itself; -1 where there is none. */
export function nextIndex(count: number, from: number, direction: number, fits: (index: number) => boolean): number {
  for (let i = from + direction; i >= 0 && i < count; i += direction) if (fits(i)) return i;
  return -1;
}

/** A run of equal values of a column, from the first index to the last. */
export interface Run {
  first: number;
  last: number;
  value: number;
}

export function runsOf(column: ArrayLike<number>): Run[] {
  const runs: Run[] = [];
  for (let i = 0; i < column.length; ++i) {
    const run = runs[runs.length - 1];
    if (run !== undefined && Object.is(run.value, column[i])) run.last = i;
    else runs.push({ first: i, last: i, value: column[i] });
  }
  return runs;
}

export type Verdict = "unknown" | "valid" | "refused" | "wrong";

/** A pose that is valid and yet not true is wrong; one that is not valid was refused. Recordings of others do not say. */
export function verdictOf(valid: number, wrong: number): Verdict {
  if (Number.isNaN(valid)) return "unknown";
  if (valid !== 1) return "refused";
  return wrong === 1 ? "wrong" : "valid";
}
