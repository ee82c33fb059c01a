import assert from "node:assert/strict";
import { test } from "node:test";
import type { Scan, ScanColumn, Series } from "../../src/api/decode.ts";
import { SCAN_COLUMNS } from "../../src/api/decode.ts";
import type { ValueInfo } from "../../src/api/types.ts";
import type { FrameColumns } from "../../src/log/log.ts";
import { pagesOf, rowAfterKey, visibleRows } from "../../src/views/events/rows.ts";
import { firstValues } from "../../src/views/plots/choice.ts";
import { hasValues, plotData, thinned, timeOfLargest, valueAt } from "../../src/views/plots/data.ts";
import { limitsOf, paint } from "../../src/views/scene3d/colours.ts";
import { ellipsoidOf, weakNote } from "../../src/views/scene3d/ellipsoid.ts";
import { Latest } from "../../src/views/scene3d/latest.ts";
import { extentOf, frustumSegments, missedSegments, patternPlaces } from "../../src/views/scene3d/segments.ts";
import { timeToX, verdictPixels, xToTime } from "../../src/views/timeline/draw.ts";
import { normal, seeded } from "./seeded.ts";

function scanOf(rows: Partial<Record<ScanColumn, number>>[]): Scan {
  const columns = Object.fromEntries(SCAN_COLUMNS.map((name) => [name, Float32Array.from(rows, (row) => row[name] ?? Number.NaN)]));
  return { count: rows.length, columns: columns as Record<ScanColumn, Float32Array> };
}

test("one wrong frame among thousands is seen on the time line", () => {
  const frames = 50_000;
  const time_s = Float64Array.from({ length: frames }, (_, i) => 0.2 * i);
  const valid = new Float32Array(frames).fill(1);
  const wrong = new Float32Array(frames);
  wrong[31_234] = 1;
  const columns: FrameColumns = { time_s, number: new Float32Array(frames), valid, wrong, mode: new Float32Array(frames) };
  const window = { from_s: 0, to_s: 0.2 * frames };
  const pixels = verdictPixels(columns, window, 800);
  const x = Math.floor(timeToX(time_s[31_234], window, 800));
  assert.equal(pixels[x], 3);
  assert.equal(pixels.filter((value) => value === 3).length, 1);
  assert.ok(pixels.every((value) => value >= 0));
});

test("pixels and times of the time line are each other's inverse", () => {
  const window = { from_s: 3, to_s: 17 };
  for (const x of [0, 123.5, 900]) assert.ok(Math.abs(timeToX(xToTime(x, window, 900), window, 900) - x) < 1e-9);
});

const seriesOf = (time_s: number[], last: number[]): Series => ({
  time_s: Float64Array.from(time_s),
  min: Float32Array.from(last),
  max: Float32Array.from(last),
  last: Float32Array.from(last),
});

test("series of different times share one axis; a value that is missing is a gap, another series' time is none", () => {
  const data = plotData([seriesOf([1, 2, 4], [10, Number.NaN, 30]), seriesOf([2, 3], [5, 6])]);
  assert.deepEqual(data[0], [1, 2, 3, 4]);
  assert.deepEqual(data[1], [10, null, undefined, 30]);
  assert.deepEqual(data[4], [undefined, 5, 6, undefined]);
});

test("a plot of gaps alone has no values", () => {
  assert.ok(hasValues(plotData([seriesOf([1, 2], [Number.NaN, 3])])));
  assert.ok(!hasValues(plotData([seriesOf([1, 2], [Number.NaN, Number.NaN])])));
  assert.ok(!hasValues(plotData([])));
});

test("the value at the cursor is the last one known, and the largest is found among gaps", () => {
  const series = seriesOf([1, 2, 4], [10, Number.NaN, 30]);
  assert.equal(valueAt(series, 0.5), null);
  assert.equal(valueAt(series, 1.9), 10);
  assert.equal(valueAt(series, 2.5), null);
  assert.equal(timeOfLargest(series), 4);
  assert.ok(Number.isNaN(timeOfLargest(seriesOf([], []))));
});

test("a thinned table keeps its first and last row", () => {
  const rows = thinned(12_345, 200);
  assert.deepEqual([rows.length, rows[0], rows[199]], [200, 0, 12_344]);
  assert.deepEqual(thinned(3, 200), [0, 1, 2]);
});

test("the first plots are errors where they are, else what the recording has", () => {
  const value = (id: string): ValueInfo => ({ id, label: id, unit: "", topic: "", group: "" });
  assert.deepEqual(firstValues([value("a"), value("error.position"), value("b")], 1400), [["error.position"], ["a"], ["b"]]);
  assert.deepEqual(firstValues([], 1400), []);
});

test("a long list draws what is in sight and asks for its pages", () => {
  const visible = visibleRows(24 * 1000, 240, 24, 100_000);
  assert.ok(visible.first <= 1000 && visible.last >= 1010 && visible.last - visible.first < 40);
  assert.deepEqual(pagesOf({ first: 190, last: 410 }), [0, 1, 2]);
  assert.deepEqual(pagesOf(visibleRows(0, 240, 24, 3)), [0]);
  assert.equal(rowAfterKey("ArrowDown", 4, 5, 10), 4);
  assert.equal(rowAfterKey("PageUp", 4, 50, 10), 0);
  assert.equal(rowAfterKey("x", 4, 50, 10), null);
});

test("limits of residuals are alike on both sides and not stretched by outliers", () => {
  const draw = seeded(2);
  const values = Float32Array.from({ length: 1000 }, (_, i) => (i % 100 === 0 ? 5 : 0.001 * normal(draw)));
  const [low, high] = limitsOf(values, "diverging");
  assert.equal(low, -high);
  assert.ok(high >= 0.001 && high <= 0.005, String(high));
});

test("a third of wrong returns leaves the scale to the others", () => {
  const draw = seeded(3);
  const values = Float32Array.from({ length: 1000 }, (_, i) => (i % 3 === 0 ? 5 * draw() : 0.001 * normal(draw)));
  const [, high] = limitsOf(values, "diverging");
  assert.ok(high >= 0.001 && high <= 0.01, String(high));
});

test("only returns set the scale; classes are counted", () => {
  const scan = scanOf([
    { state: 0, range_m: 4, part: 1 },
    { state: 0, range_m: 5, part: 1 },
    { state: 1, range_m: 90, part: -1 },
  ]);
  assert.ok(paint(scan, "range", []).legend.high <= 5);
  const { legend } = paint(scan, "part", ["tube", "array"]);
  assert.deepEqual(legend.classes, [{ label: "array", index: 1, count: 2 }]);
  const states = paint(scan, "state", []).legend.classes.map((each) => [each.label, each.count]);
  assert.deepEqual(states, [
    ["return", 2],
    ["nothing came back", 1],
  ]);
});

test("a missed ray is drawn along its direction, about where it passes the target", () => {
  const scan = scanOf([
    { state: 1, x: 1, y: 2, z: 4 },
    { state: 0, x: 9, y: 9, z: 9 },
  ]);
  const places = missedSegments(scan);
  assert.equal(places.length, 6);
  for (const at of [0, 3]) {
    assert.ok(Math.abs(places[at + 1] / places[at] - 2) < 1e-6);
    assert.ok(Math.abs(places[at + 2] / places[at] - 4) < 1e-6);
  }
  assert.ok(places[2] < 4 && places[5] > 4);
});

test("the pattern keeps the order of the scan, at one distance", () => {
  const places = patternPlaces(scanOf([{ x: 0, y: 0, z: 2 }, { x: 3, y: 0, z: 4 }, {}]), 5);
  assert.deepEqual(places, [0, 0, 5, 3, 0, 4]);
});

test("corners of the field of view lie at half its angles", () => {
  const places = frustumSegments({ frustum_deg: [30, 20], range_m: [0.5, 12] }, 4);
  const corners = [];
  for (let i = 0; i < places.length; i += 3) if (places[i + 2] === 4) corners.push([places[i], places[i + 1]]);
  assert.ok(corners.length >= 4);
  for (const [x, y] of corners) {
    assert.ok(Math.abs((Math.atan2(Math.abs(x), 4) * 180) / Math.PI - 15) < 1e-9);
    assert.ok(Math.abs((Math.atan2(Math.abs(y), 4) * 180) / Math.PI - 10) < 1e-9);
  }
});

test("the ellipsoid has the covariance's axes, magnified by a round number that is said", () => {
  const covariance = new Array(36).fill(0);
  covariance[0] = 0.001 ** 2;
  covariance[7] = 0.004 ** 2;
  covariance[14] = 0.0005 ** 2;
  const ellipsoid = ellipsoidOf(covariance, 1.3)!;
  assert.deepEqual(
    ellipsoid.sigma_mm.map((sigma) => Math.round(1e6 * sigma) / 1e6),
    [4, 1, 0.5],
  );
  assert.equal(Math.abs(ellipsoid.halfAxes[0].direction[1]), 1);
  assert.ok(Math.abs(ellipsoid.halfAxes[0].length_m - 3 * 0.004 * ellipsoid.magnification) < 1e-12);
  assert.ok(ellipsoid.halfAxes[0].length_m <= 0.3 * 1.3 && ellipsoid.magnification > 1);
  assert.equal(ellipsoidOf(null, 1), null);
  assert.equal(ellipsoidOf(new Array(36).fill(0), 1), null);
});

test("a weak direction is said by what it moves most", () => {
  assert.match(weakNote({ direction: [0, 1, 0, 0, 0, 0], sigma: 0.002 }, 0), /shift along .* sigma 2\.00 mm/);
  assert.match(weakNote({ direction: [0, 0, 0, 0, 0, 1], sigma: 0.003 }, 1), /turn about .* sigma 3\.00 mm at the target's rim/);
});

test("of many requests the first and the last are made, and the answers come in order", async () => {
  const latest = new Latest<number>();
  const made: number[] = [];
  const taken: number[] = [];
  const fail = () => assert.fail("none fails");
  const answers: (() => void)[] = [];
  for (let i = 0; i < 20; ++i) {
    const make = () => {
      made.push(i);
      return new Promise<number>((resolve) => answers.push(() => resolve(i)));
    };
    latest.ask(make, (value) => taken.push(value), fail);
  }
  assert.deepEqual(made, [0]);
  answers[0]();
  await new Promise(setImmediate);
  assert.deepEqual(made, [0, 19]);
  answers[1]();
  await new Promise(setImmediate);
  assert.deepEqual(taken, [0, 19]);
});

test("without a pose the camera looks at the middle of the returns, from a distance by their spread", () => {
  const extent = extentOf(
    scanOf([
      { state: 0, x: 1, y: 0, z: 5 },
      { state: 0, x: -1, y: 0, z: 5 },
      { state: 1, x: 50, y: 50, z: 50 },
    ]),
  )!;
  assert.deepEqual(extent.middle, [0, 0, 5]);
  assert.equal(extent.size_m, 4);
  assert.equal(extentOf(scanOf([{ state: 1, x: 1, y: 1, z: 1 }])), null);
});
