// Binary answers of the server into arrays: little endian, columns one after the other.

export const SCAN_COLUMNS = ["x", "y", "z", "residual_m", "sigma_m", "range_m", "age_s", "state", "part"] as const;
export type ScanColumn = (typeof SCAN_COLUMNS)[number];

/** One scan in the sensor's frame; NaN where a column has no value. */
export interface Scan {
  count: number;
  columns: Record<ScanColumn, Float32Array>;
}

/** A plotted value, decimated: the least, largest and last value of each bin. */
export interface Series {
  time_s: Float64Array;
  min: Float32Array;
  max: Float32Array;
  last: Float32Array;
}

const HEADER_BYTES = 8;

function expectBytes(what: string, buffer: ArrayBuffer, bytes: number): void {
  if (buffer.byteLength !== bytes) throw new Error(`${what} has ${buffer.byteLength} bytes, ${bytes} were expected`);
}

// Columns may begin anywhere: a copy is aligned.
const float32 = (buffer: ArrayBuffer, at: number, count: number) => new Float32Array(buffer.slice(at, at + 4 * count));
const float64 = (buffer: ArrayBuffer, at: number, count: number) => new Float64Array(buffer.slice(at, at + 8 * count));

export function decodeScan(buffer: ArrayBuffer): Scan {
  if (buffer.byteLength < HEADER_BYTES) throw new Error("a scan of less than its header");
  const header = new DataView(buffer);
  const count = header.getUint32(0, true);
  const columnsThere = header.getUint32(4, true);
  expectBytes("a scan", buffer, HEADER_BYTES + 4 * count * columnsThere);
  const columns = {} as Record<ScanColumn, Float32Array>;
  SCAN_COLUMNS.forEach((name, i) => {
    columns[name] = i < columnsThere ? float32(buffer, HEADER_BYTES + 4 * count * i, count) : new Float32Array(count).fill(Number.NaN);
  });
  return { count, columns };
}

export function decodeSeries(buffer: ArrayBuffer): Series {
  const count = new DataView(buffer).getUint32(0, true);
  expectBytes("a series", buffer, 4 + 20 * count);
  const values = 4 + 8 * count;
  return {
    time_s: float64(buffer, 4, count),
    min: float32(buffer, values, count),
    max: float32(buffer, values + 4 * count, count),
    last: float32(buffer, values + 8 * count, count),
  };
}

/** Columns of all frames: time_s in double precision, all others in single. */
export function decodeColumns(buffer: ArrayBuffer, names: string[], frames: number): Map<string, Float32Array | Float64Array> {
  const columns = new Map<string, Float32Array | Float64Array>();
  let at = 0;
  for (const name of names) {
    const wide = name === "time_s";
    columns.set(name, wide ? float64(buffer, at, frames) : float32(buffer, at, frames));
    at += (wide ? 8 : 4) * frames;
  }
  expectBytes("columns of frames", buffer, at);
  return columns;
}
