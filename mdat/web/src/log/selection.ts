// What is looked at, shared by all views: the time and its frame, what is pointed at, a span of time, the visible window.
import { batch, computed, type ReadonlySignal, type Signal, signal } from "@preact/signals";
import type { Log } from "./log.ts";

export interface Span {
  from_s: number;
  to_s: number;
}

/** A span with its ends in order, within the limits. */
export function orderedSpan(a_s: number, b_s: number, limits: Span): Span {
  const clamp = (t: number) => Math.min(limits.to_s, Math.max(limits.from_s, t));
  return { from_s: clamp(Math.min(a_s, b_s)), to_s: clamp(Math.max(a_s, b_s)) };
}

const LEAST_AHEAD_S = 5;

/** The end of a time line that grows: in steps of five seconds, doubled as it gets longer. */
export function horizonOf(from_s: number, to_s: number): number {
  const length_s = Math.max(to_s - from_s, LEAST_AHEAD_S);
  const step_s = LEAST_AHEAD_S * 2 ** Math.floor(Math.log2(length_s / LEAST_AHEAD_S));
  return from_s + step_s * (Math.floor(Math.max(0, to_s - from_s) / step_s) + 1);
}

export class Selection {
  readonly log: Log;
  readonly time_s: Signal<number>;
  readonly frame: ReadonlySignal<number>;
  /** Time under the pointer in a plot or on the time line. */
  readonly hovered_s: Signal<number | null> = signal(null);
  /** Row of the scan that is pointed at in the 3D view. */
  readonly hoveredPoint: Signal<number | null> = signal(null);
  readonly span: Signal<Span | null> = signal(null);
  readonly loop: Signal<boolean> = signal(false);
  /** The part of the recording that plots and time line show. */
  readonly window: Signal<Span>;
  /** Iteration whose residuals are shown; null is the result. */
  readonly iteration: Signal<number | null> = signal(null);
  /** The newest frame of a live run is selected, and the next one will be. */
  readonly following: Signal<boolean> = signal(false);

  constructor(log: Log) {
    this.log = log;
    this.time_s = signal(log.start_s);
    this.frame = computed(() => log.frameAt(this.time_s.value));
    this.window = signal(this.whole);
  }

  /** From the first frame to the last. */
  get data(): Span {
    const { start_s, end_s } = this.log;
    return { from_s: start_s, to_s: end_s > start_s ? end_s : start_s + 1 };
  }

  /** The data; while they grow, with room for the next frames, so that axes seldom change. */
  get whole(): Span {
    const { from_s, to_s } = this.data;
    return this.log.live.value ? { from_s, to_s: horizonOf(from_s, to_s) } : { from_s, to_s };
  }

  setTime(time_s: number): void {
    const { from_s, to_s } = this.data;
    batch(() => {
      const before = this.frame.peek();
      this.time_s.value = Math.min(to_s, Math.max(from_s, time_s));
      this.following.value = this.log.live.peek() && this.time_s.peek() >= this.log.end_s;
      if (this.frame.peek() !== before) this.iteration.value = null;
      this.follow();
    });
  }

  setFrame(frame: number): void {
    const last = this.log.frames - 1;
    if (last < 0) return;
    this.setTime(this.log.columns.time_s[Math.min(last, Math.max(0, frame))]);
  }

  /** A live run has more frames, or has ended: a window that showed all still does. `change` brings them. */
  grow(change: () => void): void {
    const before = this.whole;
    const shown = this.window.peek();
    const all = shown.from_s <= before.from_s && shown.to_s >= before.to_s;
    const following = this.following.peek();
    batch(() => {
      change();
      if (all) this.setWindow(this.whole);
      if (following) this.setFrame(this.log.frames - 1);
    });
  }

  setSpan(span: Span | null): void {
    this.span.value = span === null ? null : orderedSpan(span.from_s, span.to_s, this.whole);
    if (span === null) this.loop.value = false;
  }

  /** Shows a window, at least ten milliseconds wide and within the recording. */
  setWindow(window: Span): void {
    const whole = this.whole;
    const width = Math.min(whole.to_s - whole.from_s, Math.max(0.01, window.to_s - window.from_s));
    const from_s = Math.min(whole.to_s - width, Math.max(whole.from_s, window.from_s));
    this.window.value = { from_s, to_s: from_s + width };
  }

  /** Zooms about a time; a factor below 1 shows less. */
  zoom(factor: number, about_s: number): void {
    const { from_s, to_s } = this.window.peek();
    this.setWindow({ from_s: about_s - (about_s - from_s) * factor, to_s: about_s + (to_s - about_s) * factor });
  }

  pan(by_s: number): void {
    const { from_s, to_s } = this.window.peek();
    this.setWindow({ from_s: from_s + by_s, to_s: to_s + by_s });
  }

  /** Moves the window so that the time stays visible. */
  private follow(): void {
    const { from_s, to_s } = this.window.peek();
    const time_s = this.time_s.peek();
    if (time_s < from_s) this.pan(time_s - from_s - 0.1 * (to_s - from_s));
    else if (time_s > to_s) this.pan(time_s - to_s + 0.1 * (to_s - from_s));
  }
}
