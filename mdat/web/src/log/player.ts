// Moves the selected time as the clock goes: either way, at any speed, round a span.
import { type Signal, signal } from "@preact/signals";
import type { Selection, Span } from "./selection.ts";

const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4, 8, 16];

export class Player {
  private readonly selection: Selection;
  readonly playing: Signal<boolean> = signal(false);
  /** Recorded seconds a second; always above zero. */
  readonly speed: Signal<number> = signal(1);
  readonly direction: Signal<1 | -1> = signal(1);

  constructor(selection: Selection) {
    this.selection = selection;
  }

  /** Plays or pauses; at the end it begins anew. */
  toggle(): void {
    if (this.playing.peek()) this.pause();
    else this.play(this.direction.peek());
  }

  play(direction: 1 | -1): void {
    if (this.selection.log.frames === 0) return;
    this.direction.value = direction;
    const { from_s, to_s } = this.range();
    const time_s = this.selection.time_s.peek();
    const atEnd = direction === 1 ? time_s >= to_s : time_s <= from_s;
    if (atEnd || time_s < from_s || time_s > to_s) this.selection.setTime(direction === 1 ? from_s : to_s);
    this.playing.value = true;
  }

  pause(): void {
    this.playing.value = false;
  }

  /** The keys J and L: plays that way, and faster with each further stroke. */
  shuttle(direction: 1 | -1): void {
    if (this.playing.peek() && this.direction.peek() === direction) this.changeSpeed(1);
    else {
      this.speed.value = 1;
      this.play(direction);
    }
  }

  /** The next speed of the list in that direction. */
  changeSpeed(steps: 1 | -1): void {
    const at = SPEEDS.indexOf(this.speed.peek());
    const next = Math.min(SPEEDS.length - 1, Math.max(0, (at < 0 ? 3 : at) + steps));
    this.speed.value = SPEEDS[next];
  }

  step(frames: number): void {
    this.pause();
    this.selection.setFrame(this.selection.frame.peek() + frames);
  }

  goTo(frame: number): void {
    this.pause();
    this.selection.setFrame(frame);
  }

  /** Lets so many seconds of the clock pass. */
  advance(seconds: number): void {
    if (!this.playing.peek()) return;
    const { from_s, to_s } = this.range();
    const time_s = this.selection.time_s.peek() + this.direction.peek() * this.speed.peek() * seconds;
    if (time_s >= from_s && time_s <= to_s) this.selection.setTime(time_s);
    else this.reachEnd(time_s, from_s, to_s);
  }

  private reachEnd(time_s: number, from_s: number, to_s: number): void {
    if (this.selection.loop.peek()) {
      this.selection.setTime(this.direction.peek() === 1 ? from_s : to_s);
      return;
    }
    this.selection.setTime(time_s > to_s ? to_s : from_s);
    this.pause();
  }

  /** What is played: the span while it is looped, else all. */
  private range(): Span {
    const { span, loop, data } = this.selection;
    return loop.peek() && span.peek() !== null ? (span.peek() as Span) : data;
  }
}

export const PLAYER_SPEEDS: readonly number[] = SPEEDS;
