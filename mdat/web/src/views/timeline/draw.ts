// Draws the time line on a canvas: the verdict of each frame, the mode, events and the axis of time.
import type { LogEvent } from "../../api/types.ts";
import { type Run, runsOf, type Verdict, verdictOf } from "../../log/frames.ts";
import type { FrameColumns } from "../../log/log.ts";
import type { Span } from "../../log/selection.ts";
import { ticks, tickTexts } from "../../maths/scales.ts";
import type { Size } from "../../parts/use_size.ts";

export interface TimelineColours {
  text: string;
  line: string;
  ground: string;
  verdicts: Record<Verdict, string>;
  events: Record<string, string>;
  modes: [string, string];
}

export interface TimelineContent {
  columns: FrameColumns;
  modes: string[];
  modeRuns: Run[];
  events: LogEvent[];
  window: Span;
}

const VERDICT_PX = 14;
const MODE_PX = 15;
const EVENT_PX = 9;
const GAP_PX = 3;
/** Worse verdicts win where many frames share a pixel. */
const SEVERITY: Verdict[] = ["unknown", "valid", "refused", "wrong"];

export const timeToX = (time_s: number, window: Span, width: number): number =>
  ((time_s - window.from_s) / (window.to_s - window.from_s)) * width;
export const xToTime = (x: number, window: Span, width: number): number => window.from_s + (x / width) * (window.to_s - window.from_s);

/** The worst verdict in each pixel: an index into SEVERITY, or -1 where no frame is. A frame reaches to the next one. */
export function verdictPixels(columns: FrameColumns, window: Span, width: number): Int8Array {
  const pixels = new Int8Array(width).fill(-1);
  const { time_s, valid, wrong } = columns;
  for (let i = 0; i < time_s.length; ++i) {
    const end_s = i + 1 < time_s.length ? time_s[i + 1] : 2 * time_s[i] - (i > 0 ? time_s[i - 1] : time_s[i] - 0.2);
    const from = Math.max(0, Math.floor(timeToX(time_s[i], window, width)));
    const to = Math.min(width, Math.max(from + 1, Math.floor(timeToX(end_s, window, width))));
    const severity = SEVERITY.indexOf(verdictOf(valid[i], wrong[i]));
    for (let x = from; x < to; ++x) pixels[x] = Math.max(pixels[x], severity);
  }
  return pixels;
}

/** The height tells the verdict, too: it can be read without colour. */
const HEIGHTS: Record<Verdict, number> = { unknown: 0.2, valid: 0.45, refused: 0.72, wrong: 1 };

function drawVerdicts(pen: CanvasRenderingContext2D, content: TimelineContent, colours: TimelineColours, width: number): void {
  const pixels = verdictPixels(content.columns, content.window, width);
  for (const run of runsOf(pixels)) {
    if (run.value < 0) continue;
    const verdict = SEVERITY[run.value];
    const height = VERDICT_PX * HEIGHTS[verdict];
    pen.fillStyle = colours.verdicts[verdict];
    pen.fillRect(run.first, VERDICT_PX - height, run.last - run.first + 1, height);
  }
}

function drawModes(pen: CanvasRenderingContext2D, content: TimelineContent, colours: TimelineColours, width: number): void {
  const top = VERDICT_PX + GAP_PX;
  const { time_s } = content.columns;
  content.modeRuns.forEach((run, i) => {
    const from = timeToX(time_s[run.first], content.window, width);
    const to = run.last + 1 < time_s.length ? timeToX(time_s[run.last + 1], content.window, width) : width;
    if (to < 0 || from > width) return;
    pen.fillStyle = colours.modes[i % 2];
    pen.fillRect(from, top, to - from, MODE_PX);
    const name = content.modes[run.value] ?? "";
    if (pen.measureText(name).width > to - Math.max(0, from) - 8) return;
    pen.fillStyle = colours.text;
    pen.fillText(name, Math.max(0, from) + 4, top + MODE_PX - 4);
  });
}

function drawEvents(pen: CanvasRenderingContext2D, content: TimelineContent, colours: TimelineColours, width: number): void {
  const top = VERDICT_PX + MODE_PX + 2 * GAP_PX;
  const drawn = new Set<string>();
  for (const event of content.events) {
    const x = Math.round(timeToX(event.time_s, content.window, width));
    if (x < 0 || x > width || drawn.has(`${x}${event.level}`)) continue;
    drawn.add(`${x}${event.level}`);
    pen.fillStyle = colours.events[event.level] ?? colours.text;
    pen.beginPath();
    if (event.level === "info") pen.rect(x - 1, top + 2, 2, EVENT_PX - 3);
    else {
      pen.moveTo(x - 4, top + EVENT_PX);
      pen.lineTo(x + 4, top + EVENT_PX);
      pen.lineTo(x, top);
    }
    pen.fill();
  }
}

function drawAxis(pen: CanvasRenderingContext2D, content: TimelineContent, colours: TimelineColours, width: number, height: number): void {
  const { from_s, to_s } = content.window;
  const marks = ticks(from_s, to_s, Math.max(2, Math.floor(width / 90)));
  const texts = tickTexts(marks);
  pen.fillStyle = colours.text;
  pen.strokeStyle = colours.line;
  pen.beginPath();
  for (const [i, mark] of marks.entries()) {
    const x = Math.round(timeToX(mark, content.window, width)) + 0.5;
    pen.moveTo(x, 0);
    pen.lineTo(x, height - 14);
    const text = `${texts[i]} s`;
    const wide = pen.measureText(text).width;
    pen.fillText(text, Math.min(width - wide, Math.max(0, x - wide / 2)), height - 3);
  }
  pen.stroke();
}

/** Draws it all; sizes in pixels of the style sheet, things larger by a scale. */
export function drawTimeline(
  canvas: HTMLCanvasElement,
  content: TimelineContent,
  colours: TimelineColours,
  size: Size,
  scale: number,
): void {
  const density = window.devicePixelRatio || 1;
  canvas.width = Math.round(size.width * density);
  canvas.height = Math.round(size.height * density);
  const [width, height] = [Math.round(size.width / scale), size.height / scale];
  const pen = canvas.getContext("2d");
  if (pen === null) return;
  pen.scale(density * scale, density * scale);
  pen.font = "11px system-ui, sans-serif";
  drawAxis(pen, content, colours, width, height);
  drawVerdicts(pen, content, colours, width);
  drawModes(pen, content, colours, width);
  drawEvents(pen, content, colours, width);
}
