// Which values are plotted: a list of plots, each with values of one unit.
import { type Signal, signal } from "@preact/signals";
import type { RecordingInfo, ValueInfo } from "../../api/types.ts";
import { type Command, setting } from "../../app/history.ts";
import { textScale } from "../../parts/rem.ts";

export interface Plot {
  key: number;
  values: string[];
}

/** So many plots stand side by side with their numbers. */
const PLOT_PX = 440;

const SIDE_PX = 390;

/** The plots of a first look: errors where the truth is there, else the first values of the recording. */
export function firstValues(values: ValueInfo[], width_px: number): string[][] {
  const wanted = ["error.position", "error.angle", "residual.rms", "pose.inliers"];
  const found = wanted.filter((id) => values.some((value) => value.id === id));
  const others = values.map((value) => value.id).filter((id) => !found.includes(id));
  return [...found, ...others].slice(0, Math.max(1, Math.floor(width_px / PLOT_PX))).map((id) => [id]);
}

export class PlotChoice {
  private counter = 0;
  private readonly info: RecordingInfo;
  readonly plots: Signal<Plot[]>;
  readonly asTable: Signal<boolean> = signal(false);
  /** The plot that a further value is put into; null is a new one. */
  readonly addTo: Signal<number | null> = signal(null);

  constructor(info: RecordingInfo) {
    this.info = info;
    this.plots = signal(firstValues(info.values, innerWidth / textScale() - SIDE_PX).map((values) => this.make(values)));
  }

  value(id: string): ValueInfo | undefined {
    return this.info.values.find((value) => value.id === id);
  }

  /** Shows a value: in the plot that was asked for if units agree, else in a new one. */
  add(id: string): Command {
    const plots = this.plots.peek();
    const target = plots.find((plot) => plot.key === this.addTo.peek());
    const fits = target !== undefined && this.value(target.values[0])?.unit === this.value(id)?.unit && !target.values.includes(id);
    const next = fits
      ? plots.map((plot) => (plot === target ? { ...plot, values: [...plot.values, id] } : plot))
      : [...plots, this.make([id])];
    return setting(`plot of ${this.value(id)?.label ?? id}`, this.plots, next);
  }

  remove(key: number): Command {
    const plots = this.plots.peek();
    return setting(
      "closing a plot",
      this.plots,
      plots.filter((plot) => plot.key !== key),
    );
  }

  removeValue(key: number, id: string): Command {
    const plots = this.plots.peek();
    const left = plots.map((plot) => (plot.key === key ? { ...plot, values: plot.values.filter((each) => each !== id) } : plot));
    return setting(
      "taking a value away",
      this.plots,
      left.filter((plot) => plot.values.length > 0),
    );
  }

  private make(values: string[]): Plot {
    return { key: ++this.counter, values };
  }
}
