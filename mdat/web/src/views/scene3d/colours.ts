// Colours of a scan's points, and the scale of numbers that goes with them.
import type { Scan } from "../../api/decode.ts";
import { classColour, type RampName, rampColour } from "../../maths/ramps.ts";
import { niceAbove, quantile } from "../../maths/scales.ts";
import type { ColourName } from "./choice.ts";

export interface LegendContent {
  title: string;
  unit: string;
  ramp: RampName | null;
  low: number;
  high: number;
  classes: { label: string; index: number; count: number }[];
  /** Why there is nothing to colour; empty: there is. */
  lack: string;
  /** Further lines: magnification of the ellipsoid, weak directions. */
  notes: string[];
}

/** How a column becomes a number that people read. */
interface Reading {
  title: string;
  unit: string;
  factor: number;
  column: "residual_m" | "range_m" | "sigma_m" | "age_s";
  ramp: RampName;
}

const READINGS: Record<"residual" | "range" | "sigma" | "age", Reading> = {
  residual: { title: "Residual", unit: "mm", factor: 1000, column: "residual_m", ramp: "diverging" },
  range: { title: "Range", unit: "m", factor: 1, column: "range_m", ramp: "sequential" },
  sigma: { title: "Sigma of range", unit: "mm", factor: 1000, column: "sigma_m", ramp: "sequential" },
  age: { title: "Age at the frame's time", unit: "ms", factor: 1000, column: "age_s", ramp: "sequential" },
};

/** States of a ray (RayState). */
export const STATES = ["return", "nothing came back", "no statement", "lost on its way"];
export const RETURN = 0;
export const MISS = 1;

/** Most of a signed column's scale in medians of its sizes: the 95 % quantile of a normal law is at 2.9 of them. */
const MOST_MEDIANS = 4;

/** Limits that outliers do not stretch: for signed numbers alike on both sides, and by less than half of the values. */
export function limitsOf(values: ArrayLike<number>, ramp: RampName): [number, number] {
  if (ramp === "diverging") {
    const sizes = Float32Array.from(values, Math.abs);
    const most = niceAbove(Math.max(1e-12, Math.min(quantile(sizes, 0.95), MOST_MEDIANS * quantile(sizes, 0.5))));
    return Number.isFinite(most) ? [-most, most] : [-1, 1];
  }
  const low = quantile(values, 0.02);
  const high = quantile(values, 0.98);
  if (!Number.isFinite(low)) return [0, 1];
  return high > low ? [low, high] : [low - 0.5 * Math.abs(low || 1), high + 0.5 * Math.abs(high || 1)];
}

export interface Painted {
  /** Three shares of 0 to 1 a point. */
  colours: Float32Array;
  legend: LegendContent;
}

const UNKNOWN: [number, number, number] = [0.5, 0.5, 0.5];

function paintNumbers(scan: Scan, reading: Reading): Painted {
  const column = scan.columns[reading.column];
  const returns = column.filter((_, i) => scan.columns.state[i] === RETURN);
  const [low, high] = limitsOf(returns, reading.ramp);
  const colours = new Float32Array(3 * scan.count);
  for (let i = 0; i < scan.count; ++i)
    colours.set(Number.isFinite(column[i]) ? rampColour(reading.ramp, (column[i] - low) / (high - low)) : UNKNOWN, 3 * i);
  const { title, unit, factor, ramp } = reading;
  return { colours, legend: { title, unit, ramp, low: low * factor, high: high * factor, classes: [], lack: "", notes: [] } };
}

function paintClasses(scan: Scan, column: Float32Array, title: string, names: string[]): Painted {
  const colours = new Float32Array(3 * scan.count);
  const counts = new Map<number, number>();
  for (let i = 0; i < scan.count; ++i) {
    const index = column[i];
    counts.set(index, (counts.get(index) ?? 0) + 1);
    colours.set(index >= 0 ? classColour(index) : UNKNOWN, 3 * i);
  }
  const known = [...counts.keys()].filter((index) => index >= 0).sort((a, b) => a - b);
  const classes = known.map((index) => ({
    label: names[index] ?? `${title.toLowerCase()} ${index}`,
    index,
    count: counts.get(index) ?? 0,
  }));
  const lack = classes.length === 0 ? "No point belongs to a class." : "";
  return { colours, legend: { title, unit: "", ramp: null, low: 0, high: 0, classes, lack, notes: [] } };
}

function paintNothing(lack: string): Painted {
  const legend = { title: "No points", unit: "", ramp: null, low: 0, high: 0, classes: [], lack, notes: [] };
  return { colours: new Float32Array(0), legend };
}

/** A scan's points; `lack` says why there may be none. */
export function paint(scan: Scan, colour: ColourName, parts: string[], lack = "This frame has no scan."): Painted {
  if (scan.count === 0) return paintNothing(lack);
  if (colour === "state") return paintClasses(scan, scan.columns.state, "State", STATES);
  if (colour === "part") return paintClasses(scan, scan.columns.part, "Part", parts);
  return paintNumbers(scan, READINGS[colour]);
}
