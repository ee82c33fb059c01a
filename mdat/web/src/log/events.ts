// All events of a recording for the time line and for jumps, read page by page; the list of events asks the server by itself.
import { type Signal, signal } from "@preact/signals";
import type { LogEvent } from "../api/types.ts";
import type { Log } from "./log.ts";

const PAGE = 5000;
const MOST = 50000;

export class Events {
  /** Events by time, as far as they are read. */
  readonly all: Signal<LogEvent[]> = signal([]);
  readonly total: Signal<number | null> = signal(null);

  async load(log: Log): Promise<void> {
    let events: LogEvent[] = [];
    let total = 1;
    while (events.length < Math.min(total, MOST)) {
      const page = await log.events({ from: events.length, count: PAGE });
      total = page.total;
      if (page.events.length === 0) break;
      events = events.concat(page.events);
      this.all.value = events;
    }
    this.total.value = total;
  }

  /** Counts up when a live run has told more. */
  readonly grown: Signal<number> = signal(0);

  /** Asks for what a live run has added. */
  async more(log: Log): Promise<void> {
    if (this.total.peek() === null) return;
    const page = await log.events({ from: this.all.peek().length, count: PAGE });
    if (page.events.length === 0 || this.all.peek().length >= MOST) return;
    this.all.value = this.all.peek().concat(page.events);
    this.total.value = page.total;
    ++this.grown.value;
  }

  /** The nearest event before or after a frame; events of the frame itself do not count. */
  next(frame: number, direction: 1 | -1): LogEvent | null {
    const events = this.all.peek();
    if (direction === 1) return events.find((event) => event.frame > frame) ?? null;
    for (let i = events.length - 1; i >= 0; --i) if (events[i].frame < frame && events[i].frame >= 0) return events[i];
    return null;
  }
}
