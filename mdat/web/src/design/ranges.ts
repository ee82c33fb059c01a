// Which thresholds of a mission are ranges of the target, and what they divide: sensors, scanning part by part, parts, where scenarios begin.
import type { EffectiveValue } from "./types.ts";

/** A range at which something begins or ends: a value of a key, or one of its list. */
export interface Threshold {
  key: string;
  /** In the key's list; null: the key's one value. */
  index: number | null;
  value_m: number;
}

/** One line of the axis: what holds from one range to another, or single ranges. */
export interface RangeRow {
  name: string;
  meaning: string;
  /** Of the bar; null: there is none, the thresholds are single ranges. */
  band_m: [number, number] | null;
  thresholds: Threshold[];
}

type Values = Map<string, EffectiveValue>;

/** The numbers of a value as TOML writes them: one, or a list. */
export function numbersOf(text: string): number[] {
  return [...text.matchAll(/[-+]?\d[\d_]*(?:\.\d+)?(?:[eE][-+]?\d+)?/g)].map(([number]) => Number(number.replace(/_/g, "")));
}

function thresholdOf(values: Values, key: string): Threshold[] {
  const held = values.get(key);
  const [value_m] = held === undefined ? [] : numbersOf(held.value);
  return value_m === undefined ? [] : [{ key, index: null, value_m }];
}

function listOf(values: Values, key: string): Threshold[] {
  return numbersOf(values.get(key)?.value ?? "").map((value_m, index) => ({ key, index, value_m }));
}

function bandRow(values: Values, name: string, meaning: string, keys: [string, string]): RangeRow[] {
  const [from, to] = keys.map((key) => thresholdOf(values, key)[0]);
  return from === undefined || to === undefined ? [] : [{ name, meaning, band_m: [from.value_m, to.value_m], thresholds: [from, to] }];
}

function namesBelow(values: Values, table: string): string[] {
  const keys = [...values.keys()].filter((key) => key.startsWith(`${table}.`));
  return [...new Set(keys.map((key) => key.split(".")[1]))];
}

/** Which sensor is used matters where there are several. */
function sensorRows(values: Values): RangeRow[] {
  const sensors = ["sensor", ...namesBelow(values, "further_sensor").map((name) => `further_sensor.${name}`)];
  return sensors.flatMap((path) => {
    const name = path.replace("further_sensor.", "");
    const used = bandRow(values, `${name} is used`, "for a target's origin in this band", [`${path}.use_from_m`, `${path}.use_to_m`]);
    const measured = bandRow(values, `${name} measures`, "ranges that it gives", [`${path}.range_min_m`, `${path}.range_max_m`]);
    return sensors.length > 1 ? [...used, ...measured] : measured;
  });
}

function shortRangeRow(values: Values): RangeRow[] {
  const [enter, leave] = ["short_range.enter_m", "short_range.leave_m"].map((key) => thresholdOf(values, key)[0]);
  if (enter === undefined || leave === undefined || enter.value_m <= 0) return [];
  const meaning = "a target that comes as near as the first is scanned part by part, until it is as far as the second";
  return [{ name: "part by part", meaning, band_m: [0, enter.value_m], thresholds: [enter, leave] }];
}

function partRows(values: Values): RangeRow[] {
  return namesBelow(values, "part").flatMap((name) => {
    const thresholds = listOf(values, `part.${name}.range_m`);
    if (thresholds.length !== 2) return [];
    const band_m: [number, number] = [thresholds[0].value_m, thresholds[1].value_m];
    return [{ name: `part ${name}`, meaning: "distance of its centre at which it serves", band_m, thresholds }];
  });
}

function scenarioRows(values: Values): RangeRow[] {
  return namesBelow(values, "scenario").flatMap((name) => {
    const thresholds = listOf(values, `scenario.${name}.ranges_m`);
    return thresholds.length === 0 ? [] : [{ name: `scenario ${name}`, meaning: "ranges of its runs", band_m: null, thresholds }];
  });
}

/** All rows; those of scenarios for the one that is looked at alone, as there may be many. */
export function rangeRows(values: Values, section: string): RangeRow[] {
  const scenarios = scenarioRows(values).filter(({ thresholds }) => thresholds[0].key.startsWith(`${section}.`));
  return [...sensorRows(values), ...shortRangeRow(values), ...partRows(values), ...scenarios];
}

/** Whether a table has a threshold among the rows. */
export const hasRanges = (rows: RangeRow[], section: string): boolean =>
  rows.some(({ thresholds }) => thresholds.some(({ key }) => key.startsWith(`${section}.`)));

/** A logarithmic axis: from the power of ten or its double or half below the least range above 0, to that above the largest. */
export interface RangeAxis {
  low_m: number;
  high_m: number;
  ticks_m: number[];
}

export function axisOf(rows: RangeRow[]): RangeAxis {
  const places = rows.flatMap(({ thresholds }) => thresholds.map(({ value_m }) => value_m)).filter((value_m) => value_m > 0);
  const decade = (x: number, round: (y: number) => number) => 10 ** round(Math.log10(x) - (round === Math.ceil ? 1e-9 : -1e-9));
  const low_m = places.length === 0 ? 0.1 : decade(Math.min(...places), Math.floor);
  const high_m = places.length === 0 ? 100 : Math.max(decade(Math.max(...places), Math.ceil), 10 * low_m);
  const count = Math.round(Math.log10(high_m / low_m));
  return { low_m, high_m, ticks_m: Array.from({ length: count + 1 }, (_, i) => Number((low_m * 10 ** i).toPrecision(6))) };
}

/** Where a range is on the axis, from 0 to 1; 0 is at its beginning. */
export function shareOf({ low_m, high_m }: RangeAxis, value_m: number): number {
  if (value_m <= low_m) return 0;
  return Math.min(1, Math.log(value_m / low_m) / Math.log(high_m / low_m));
}

/** The range at a place of the axis, to three figures. */
export function rangeAt({ low_m, high_m }: RangeAxis, share: number): number {
  return Number((low_m * (high_m / low_m) ** Math.min(1, Math.max(0, share))).toPrecision(3));
}

/** A step of the arrow keys: 2 figures' last one up or down. */
export function stepped(value_m: number, up: boolean): number {
  if (value_m <= 0) return up ? 0.1 : 0;
  const unit = 10 ** (Math.floor(Math.log10(value_m) + 1e-9) - 1);
  const below = !up && value_m <= 10 * unit * (1 + 1e-9) ? unit / 10 : unit;
  return Number((Math.round(value_m / below) * below + (up ? below : -below)).toPrecision(6));
}

/** The key's value with another range in a threshold's place, as TOML. */
export function withRange(values: Values, { key, index }: Threshold, value_m: number): string {
  if (index === null) return String(value_m);
  return `[${numbersOf(values.get(key)?.value ?? "")
    .map((old, i) => (i === index ? value_m : old))
    .join(", ")}]`;
}
