// One uPlot chart: lines with the band of least and largest, the cursor and the span as elements above it, so that they move without drawing.
import uPlot from "uplot";
import type { ValueInfo } from "../../api/types.ts";
import { cssValue } from "../../app/theme.ts";
import type { Span } from "../../log/selection.ts";
import { tickTexts } from "../../maths/scales.ts";
import { textScale } from "../../parts/rem.ts";
import { hasValues, type PlotData } from "./data.ts";

const COLOURS = ["--series-1", "--series-2", "--series-3", "--series-4", "--series-5", "--series-6"];
export const seriesColour = (i: number): string => COLOURS[i % COLOURS.length];

function seriesOptions(values: ValueInfo[]): uPlot.Series[] {
  const drawn = values.flatMap((value, i): uPlot.Series[] => {
    const colour = cssValue(seriesColour(i));
    const edge: uPlot.Series = { stroke: "transparent", width: 0, points: { show: false } };
    return [{ label: value.label, stroke: colour, width: 1.5, points: { size: 4 }, spanGaps: false }, { ...edge }, { ...edge }];
  });
  return [{}, ...drawn];
}

function bandOptions(values: ValueInfo[]): uPlot.Band[] {
  return values.map((_, i) => ({ series: [3 * i + 3, 3 * i + 2], fill: `${cssValue(seriesColour(i))}40` }));
}

/** What a scale of values shows; where there is none, something, so that its axis keeps its room. */
const valueRange: uPlot.Range.Function = (_, low, high) => (low === null ? [0, 1] : uPlot.rangeNum(low, high, 0.1, true));

/** Room for the longest number beside its tick. */
function axisWidth(texts: string[] | null, scale: number): number {
  const longest = Math.max(4, ...(texts ?? []).map((text) => text.length));
  return (6.8 * longest + 14) * scale;
}

function axisOptions(): uPlot.Axis[] {
  const scale = textScale();
  const common: uPlot.Axis = {
    stroke: cssValue("--text-2"),
    grid: { stroke: cssValue("--line"), width: 1 },
    ticks: { stroke: cssValue("--line"), size: 4 },
    font: `${11 * scale}px system-ui, sans-serif`,
    values: (_, marks) => tickTexts(marks),
  };
  return [
    { ...common, size: 24 * scale, space: 70 * scale, values: (_, marks) => tickTexts(marks).map((text) => `${text} s`) },
    { ...common, size: (_, texts) => axisWidth(texts, scale), space: 26 * scale },
  ];
}

/** A chart in an element; `set…` change what it shows. */
export class Chart {
  private readonly plot: uPlot;
  private readonly cursor = document.createElement("div");
  private readonly hover = document.createElement("div");
  private readonly spanBox = document.createElement("div");
  private readonly nothing = document.createElement("p");

  private marks: { time_s: number; hovered_s: number | null; span: Span | null } | null = null;

  constructor(parent: HTMLElement, values: ValueInfo[], data: PlotData, window: Span, width: number, height: number) {
    const options: uPlot.Options = {
      width,
      height,
      legend: { show: false },
      cursor: { show: false },
      padding: [6, 18, 0, 0], // half of the longest tick of time
      scales: { x: { time: false, range: (_, low, high) => [low, high] }, y: { range: valueRange } },
      series: seriesOptions(values),
      bands: bandOptions(values),
      axes: axisOptions(),
      // uPlot settles its scales later: marks are put again then.
      hooks: { setScale: [() => this.putMarks()], setSize: [() => this.putMarks()], ready: [() => this.putMarks()] },
    };
    this.plot = new uPlot(options, data as uPlot.AlignedData, parent);
    this.cursor.className = "cursor-line";
    this.hover.className = "hover-line";
    this.spanBox.className = "span";
    this.nothing.className = "chart-nothing";
    this.nothing.textContent = "No value in the time that is shown.";
    this.nothing.hidden = hasValues(data);
    this.over.append(this.spanBox, this.hover, this.cursor, this.nothing);
    this.setWindow(window);
  }

  /** The element above the chart's area, for the pointer. */
  get over(): HTMLElement {
    return this.plot.over;
  }

  get canvas(): HTMLCanvasElement {
    return this.plot.ctx.canvas;
  }

  /** The time under the pointer, of a window that may be newer than what is drawn. */
  timeAt(event: MouseEvent, { from_s, to_s }: Span): number {
    const { left, width } = this.over.getBoundingClientRect();
    return from_s + ((event.clientX - left) / width) * (to_s - from_s);
  }

  setData(data: PlotData, window: Span): void {
    this.plot.batch(() => {
      this.plot.setData(data as uPlot.AlignedData, true);
      this.nothing.hidden = hasValues(data);
      this.setWindow(window);
    });
  }

  setWindow({ from_s, to_s }: Span): void {
    this.plot.setScale("x", { min: from_s, max: to_s });
  }

  setSize(width: number, height: number): void {
    this.plot.setSize({ width, height });
  }

  setMarks(time_s: number, hovered_s: number | null, span: Span | null): void {
    this.marks = { time_s, hovered_s, span };
    this.putMarks();
  }

  destroy(): void {
    this.plot.destroy();
  }

  private putMarks(): void {
    if (this.marks === null || this.plot === undefined) return;
    const { time_s, hovered_s, span } = this.marks;
    const x = (time: number) => this.plot.valToPos(time, "x");
    this.cursor.style.transform = `translateX(${x(time_s)}px)`;
    this.hover.hidden = hovered_s === null;
    if (hovered_s !== null) this.hover.style.transform = `translateX(${x(hovered_s)}px)`;
    this.spanBox.hidden = span === null;
    if (span === null) return;
    this.spanBox.style.left = `${x(span.from_s)}px`;
    this.spanBox.style.width = `${x(span.to_s) - x(span.from_s)}px`;
  }
}
