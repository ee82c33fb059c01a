import assert from "node:assert/strict";
import { test } from "node:test";
import { block3, symmetricAxes } from "../../src/maths/eigen.ts";
import { rampColour } from "../../src/maths/ramps.ts";
import {
  decimalsOf,
  niceAbove,
  niceBelow,
  quantile,
  sentence,
  shortNumber,
  ticks,
  tickTexts,
  timeText,
  withUnit,
} from "../../src/maths/scales.ts";
import { angleBetween_deg, cross, dot, multiply, norm, type Quaternion, type Vec3 } from "../../src/maths/vectors.ts";
import { normal, seeded } from "./seeded.ts";

const times = (a: number[][], v: Vec3): Vec3 => a.map((row) => row[0] * v[0] + row[1] * v[1] + row[2] * v[2]) as Vec3;

function drawnQuaternion(draw: () => number): Quaternion {
  const q = [normal(draw), normal(draw), normal(draw), normal(draw)];
  const length = Math.hypot(...q);
  return q.map((x) => x / length) as Quaternion;
}

test("the axes of drawn covariances are eigenvectors: right-handed, of length one, the largest first", () => {
  const draw = seeded(11);
  for (let trial = 0; trial < 50; ++trial) {
    const b = [0, 1, 2].map(() => [normal(draw), normal(draw), normal(draw)]);
    const a = [0, 1, 2].map((i) => [0, 1, 2].map((k) => b[i][0] * b[k][0] + b[i][1] * b[k][1] + b[i][2] * b[k][2]));
    const axes = symmetricAxes(a);
    for (const { value, vector } of axes) {
      const image = times(a, vector);
      for (let i = 0; i < 3; ++i) assert.ok(Math.abs(image[i] - value * vector[i]) < 1e-9 * (1 + axes[0].value));
      assert.ok(Math.abs(norm(vector) - 1) < 1e-9);
    }
    assert.ok(axes[0].value >= axes[1].value && axes[1].value >= axes[2].value);
    assert.ok(dot(cross(axes[0].vector, axes[1].vector), axes[2].vector) > 0.999999);
  }
});

test("blocks of a covariance are taken from the diagonal: translation first, then rotation", () => {
  const covariance = Array.from({ length: 36 }, (_, i) => i);
  assert.deepEqual(block3(covariance, 0)[1], [6, 7, 8]);
  assert.deepEqual(block3(covariance, 3)[0], [21, 22, 23]);
});

test("the angle between attitudes is that of the turn from one to the other, whatever their signs", () => {
  const draw = seeded(5);
  for (let trial = 0; trial < 50; ++trial) {
    const q = drawnQuaternion(draw);
    const axis: Vec3 = [normal(draw), normal(draw), normal(draw)];
    const angle_deg = 180 * draw();
    const s = Math.sin((angle_deg * Math.PI) / 360) / norm(axis);
    const turn: Quaternion = [s * axis[0], s * axis[1], s * axis[2], Math.cos((angle_deg * Math.PI) / 360)];
    const turned = multiply(q, turn);
    assert.ok(Math.abs(angleBetween_deg(q, turned) - angle_deg) < 1e-6);
    assert.ok(Math.abs(angleBetween_deg(q, turned.map((x) => -x) as Quaternion) - angle_deg) < 1e-6);
  }
});

test("nice numbers enclose each number and are 1, 2 or 5 times a power of ten", () => {
  const draw = seeded(3);
  for (let trial = 0; trial < 500; ++trial) {
    const x = 10 ** (12 * draw() - 6);
    const [below, above] = [niceBelow(x), niceAbove(x)];
    assert.ok(below <= x * (1 + 1e-9) && x <= above * (1 + 1e-9), `${below} ${x} ${above}`);
    assert.ok(above / below < 2.6, `${below} ${x} ${above}`);
    for (const nice of [below, above]) assert.match(nice.toExponential(3), /^[125]\.000e/);
  }
});

test("ticks lie within their range, at equal steps, no more than wanted", () => {
  const found = ticks(0.93, 21.2, 7);
  assert.deepEqual(found, [5, 10, 15, 20]);
  assert.deepEqual(ticks(3, 3, 5), []);
});

test("a quantile leaves out what is not finite", () => {
  assert.equal(quantile([4, Number.NaN, 1, 3, 2], 0.5), 3);
  assert.ok(Number.isNaN(quantile([Number.NaN], 0.5)));
});

test("numbers are short, with a true minus sign, and a dash for what is not there", () => {
  assert.equal(shortNumber(-1.23456), "−1.23");
  assert.equal(shortNumber(123456), "123456");
  assert.equal(shortNumber(null), "–");
  assert.equal(shortNumber(1e-7), "1.00 × 10⁻⁷");
  assert.equal(withUnit(0.5, "mm"), "0.500 mm");
  assert.equal(withUnit(2, "°"), "2.00°");
  assert.equal(withUnit(Number.NaN, "mm"), "–");
  assert.equal(timeText(1.23456, 0.01), "1.23");
});

/** Relative luminance (WCAG). */
function luminance(rgb: number[]): number {
  const [r, g, b] = rgb.map((c) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4));
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}

test("the sequential ramp grows ever brighter: it is read without hues, too", () => {
  for (let i = 1; i <= 64; ++i) assert.ok(luminance(rampColour("sequential", i / 64)) > luminance(rampColour("sequential", (i - 1) / 64)));
});

test("the diverging ramp is brightest about zero, blue below and orange above", () => {
  const middle = luminance(rampColour("diverging", 0.5));
  assert.ok(luminance(rampColour("diverging", 0)) < 0.5 * middle && luminance(rampColour("diverging", 1)) < 0.5 * middle);
  const [low, high] = [rampColour("diverging", 0.1), rampColour("diverging", 0.9)];
  assert.ok(low[2] > low[0] && high[0] > high[2]);
});

test("ticks have the decimals of their step: no two look alike", () => {
  assert.deepEqual(tickTexts([179.9, 179.95, 180]), ["179.90", "179.95", "180.00"]);
  assert.deepEqual(tickTexts([2.5, 5, 7.5]), ["2.5", "5.0", "7.5"]);
  assert.deepEqual(tickTexts([-200, 0, 200]), ["−200", "0", "200"]);
  assert.equal(decimalsOf(0.1 + 0.2), 1);
});

test("a sentence has a capital and one full stop", () => {
  assert.equal(sentence("it is so"), "It is so.");
  assert.equal(sentence("Is it?"), "Is it?");
});
