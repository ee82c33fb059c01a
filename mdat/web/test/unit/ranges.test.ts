import assert from "node:assert/strict";
import { test } from "node:test";
import { axisOf, hasRanges, numbersOf, rangeAt, rangeRows, shareOf, stepped, withRange } from "../../src/design/ranges.ts";
import type { EffectiveValue } from "../../src/design/types.ts";
import { seeded } from "./seeded.ts";

const VALUES = {
  "sensor.range_min_m": "5",
  "sensor.range_max_m": "200",
  "sensor.use_from_m": "8.0",
  "sensor.use_to_m": "1e4",
  "further_sensor.near.range_min_m": "0.5",
  "further_sensor.near.range_max_m": "20",
  "further_sensor.near.use_from_m": "0",
  "further_sensor.near.use_to_m": "10",
  "short_range.enter_m": "4",
  "short_range.leave_m": "5",
  "part.aft.range_m": "[0.5, 6]",
  "scenario.spin.ranges_m": "[3, 5.5]",
  "scenario.other.ranges_m": "[7]",
};
const valuesOf = (values: Record<string, string>) =>
  new Map<string, EffectiveValue>(Object.entries(values).map(([key, value]) => [key, { key, value, unit: "m", place: "", line: 1 }]));

test("what changes with the range has a row, with its band and its keys", () => {
  const rows = rangeRows(valuesOf(VALUES), "scenario.spin");
  assert.deepEqual(
    rows.map(({ name, band_m }) => `${name} ${band_m?.join(" to ") ?? "-"}`),
    [
      "sensor is used 8 to 10000",
      "sensor measures 5 to 200",
      "near is used 0 to 10",
      "near measures 0.5 to 20",
      "part by part 0 to 4",
      "part aft 0.5 to 6",
      "scenario spin -",
    ],
  );
  assert.deepEqual(rows.at(-1)!.thresholds, [
    { key: "scenario.spin.ranges_m", index: 0, value_m: 3 },
    { key: "scenario.spin.ranges_m", index: 1, value_m: 5.5 },
  ]);
  for (const section of ["sensor", "further_sensor.near", "short_range", "part.aft", "scenario.spin"])
    assert.equal(hasRanges(rows, section), true, section);
  assert.equal(hasRanges(rows, "scan"), false);
});

test("one sensor is always used, and where nothing is scanned part by part there is no row of it", () => {
  const values = valuesOf({ ...VALUES, "short_range.enter_m": "0" });
  for (const key of [...values.keys()]) if (key.startsWith("further_sensor.") || key.startsWith("part.")) values.delete(key);
  assert.deepEqual(
    rangeRows(values, "scan").map(({ name }) => name),
    ["sensor measures"],
  );
});

test("the axis holds all ranges between powers of ten; places and ranges are each other's", () => {
  const axis = axisOf(rangeRows(valuesOf(VALUES), "scan"));
  assert.deepEqual(axis.ticks_m, [0.1, 1, 10, 100, 1000, 10000]);
  assert.equal(shareOf(axis, 0), 0);
  assert.equal(shareOf(axis, 1e4), 1);
  const random = seeded(5);
  for (let i = 0; i < 200; ++i) {
    const range_m = rangeAt(axis, random());
    assert.ok(Math.abs(rangeAt(axis, shareOf(axis, range_m)) - range_m) <= 0.006 * range_m, String(range_m));
  }
  assert.deepEqual(axisOf([]).ticks_m, [0.1, 1, 10, 100]);
});

test("arrow keys move a range by its second figure, up and down by the same", () => {
  for (const [value_m, above_m] of [
    [4, 4.1],
    [10, 11],
    [0.5, 0.51],
    [99, 100],
    [9.9, 10],
    [123, 130],
  ]) {
    assert.equal(stepped(value_m, true), above_m);
    if (value_m !== 123) assert.equal(stepped(above_m, false), value_m);
  }
  assert.equal(stepped(0, true), 0.1);
  assert.equal(stepped(0, false), 0);
});

test("a range is written as its key has it: alone, or in its list", () => {
  const values = valuesOf(VALUES);
  assert.equal(withRange(values, { key: "short_range.enter_m", index: null, value_m: 4 }, 4.5), "4.5");
  assert.equal(withRange(values, { key: "part.aft.range_m", index: 1, value_m: 6 }, 7), "[0.5, 7]");
  assert.deepEqual(numbersOf("[1_000, -2.5e-1, 3]"), [1000, -0.25, 3]);
});
