// The model of one recording: what it is, the columns of all frames, and frames, scans, series and events as they are asked for.
// It knows no view. What was asked for lately is kept, so that memory stays flat in long recordings.
import { signal } from "@preact/signals";
import { getBinary, getJson, withQuery } from "../api/client.ts";
import { decodeColumns, decodeScan, decodeSeries, type Scan, type Series } from "../api/decode.ts";
import type { EventPage, FrameInfo, RecordingInfo, Statistics } from "../api/types.ts";
import { unitText } from "../api/units.ts";
import { Cache } from "./cache.ts";
import { lastNotAbove } from "./frames.ts";

/** Columns of all frames: 1 and 0, NaN where it is not known; the mode as a number that indexes `modes`; the frame's number, as the run counts. */
export interface FrameColumns {
  time_s: Float64Array;
  number: Float32Array;
  valid: Float32Array;
  wrong: Float32Array;
  mode: Float32Array;
}

const COLUMNS = ["time_s", "number", "valid", "wrong", "mode"];
const FRAMES_KEPT = 300;
/** The sensor of a recording that was made of telemetry alone. */
const LINK = "telemetry of a link";
/** Of COLUMNS: a double and four floats. */
const FRAME_BYTES = 24;

function joined(a: FrameColumns, b: FrameColumns): FrameColumns {
  const time_s = new Float64Array(a.time_s.length + b.time_s.length);
  time_s.set(a.time_s);
  time_s.set(b.time_s, a.time_s.length);
  const float = (first: Float32Array, then: Float32Array) => {
    const both = new Float32Array(first.length + then.length);
    both.set(first);
    both.set(then, first.length);
    return both;
  };
  return {
    time_s,
    number: float(a.number, b.number),
    valid: float(a.valid, b.valid),
    wrong: float(a.wrong, b.wrong),
    mode: float(a.mode, b.mode),
  };
}

export interface EventQuery {
  from: number;
  count: number;
  filter?: string;
  level?: string;
}

export class Log {
  private readonly frameCache = new Cache<FrameInfo>(FRAMES_KEPT);
  private readonly scanCache = new Cache<Scan>(FRAMES_KEPT);
  readonly info: RecordingInfo;
  columns: FrameColumns;
  /** Frames so far: views that read it, or `frames`, are shown anew when a live run has more. */
  readonly count = signal(0);
  /** A run that flies writes it. */
  readonly live = signal(false);

  constructor(info: RecordingInfo, columns: FrameColumns) {
    this.info = info;
    this.columns = columns;
    this.count.value = columns.time_s.length;
  }

  private static async ask(id: string): Promise<RecordingInfo> {
    const told = await getJson<RecordingInfo>(`/api/recordings/${encodeURIComponent(id)}`);
    return { ...told, values: told.values.map((value) => ({ ...value, unit: unitText(value.unit) })) };
  }

  static async open(id: string): Promise<Log> {
    const path = `/api/recordings/${encodeURIComponent(id)}`;
    const info = await Log.ask(id);
    const bytes = info.frames === 0 ? new ArrayBuffer(0) : await getBinary(withQuery(`${path}/frames`, { columns: COLUMNS.join(",") }));
    // A live run may have more by now than it had when it was asked what it is.
    const columns = decodeColumns(bytes, COLUMNS, Math.floor(bytes.byteLength / FRAME_BYTES));
    return new Log(info, Object.fromEntries(columns) as unknown as FrameColumns);
  }

  /** The frames that a live run has added; none: null. */
  async more(): Promise<FrameColumns | null> {
    const bytes = await getBinary(withQuery(this.path("frames"), { columns: COLUMNS.join(","), from: this.columns.time_s.length }));
    const added = Math.floor(bytes.byteLength / FRAME_BYTES);
    if (added === 0) return null;
    return Object.fromEntries(decodeColumns(bytes, COLUMNS, added)) as unknown as FrameColumns;
  }

  append(more: FrameColumns): void {
    this.columns = joined(this.columns, more);
    this.count.value = this.columns.time_s.length;
  }

  /** What the recording is, as it is now: topics and values come as a run tells them first. */
  async askAgain(): Promise<void> {
    Object.assign(this.info, await Log.ask(this.info.id));
  }

  private path(rest: string): string {
    return `/api/recordings/${encodeURIComponent(this.info.id)}/${rest}`;
  }

  /** Why a frame may have no scan. */
  get scanless(): string | undefined {
    return this.info.sensor === LINK ? "A link carries no scans." : undefined;
  }

  get frames(): number {
    return this.count.value;
  }

  get start_s(): number {
    return this.frames > 0 ? this.columns.time_s[0] : this.info.start_s;
  }

  get end_s(): number {
    return this.frames > 0 ? this.columns.time_s[this.frames - 1] : this.info.end_s;
  }

  /** As the run counts its frames: frames that were not told are left out of the columns, and counted here. */
  number(index: number): number {
    return this.frames > 0 ? this.columns.number[Math.min(this.frames - 1, Math.max(0, index))] : 0;
  }

  /** The frame of a number; where it was not told the one before it, or else the first. */
  withNumber(number: number): number {
    return lastNotAbove(this.columns.number, number);
  }

  /** The last frame that is not after the time; the first where all are. */
  frameAt(time_s: number): number {
    return lastNotAbove(this.columns.time_s, time_s);
  }

  frame(index: number): Promise<FrameInfo> {
    return this.frameCache.get(String(index), () => getJson<FrameInfo>(this.path(`frames/${index}`)));
  }

  /** The scan of a frame; with `iteration` its residuals at that iteration's pose. */
  scan(index: number, iteration?: number): Promise<Scan> {
    const path = withQuery(this.path(`frames/${index}/scan`), { iteration });
    return this.scanCache.get(path, async () => decodeScan(await getBinary(path)));
  }

  async series(value: string, from_s: number, to_s: number, points: number, signal?: AbortSignal): Promise<Series> {
    return decodeSeries(await getBinary(withQuery(this.path("series"), { value, from_s, to_s, points }), signal));
  }

  statistics(value: string, from_s: number, to_s: number, signal?: AbortSignal): Promise<Statistics> {
    return getJson<Statistics>(withQuery(this.path("statistics"), { value, from_s, to_s }), signal);
  }

  events(query: EventQuery, signal?: AbortSignal): Promise<EventPage> {
    return getJson<EventPage>(withQuery(this.path("events"), { ...query }), signal);
  }

  /** Of the target's surface; null: the recording has none. */
  get modelPath(): string | null {
    const coming = this.live.peek() && this.info.sensor !== LINK;
    return coming || this.info.topics.some(({ name }) => name === "/scene") ? this.path("model.glb") : null;
  }

  csvPath(values: string[], from_s: number, to_s: number): string {
    return withQuery(this.path("csv"), { values: values.join(","), from_s, to_s });
  }
}
