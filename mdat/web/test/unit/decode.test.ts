import assert from "node:assert/strict";
import { test } from "node:test";
import { decodeColumns, decodeScan, decodeSeries, SCAN_COLUMNS } from "../../src/api/decode.ts";

/** Bytes written one by one, so that the test does not share the decoder's way of reading. */
class Bytes {
  private readonly bytes: number[] = [];

  add(width: 4 | 8, kind: "u" | "f", value: number): this {
    const view = new DataView(new ArrayBuffer(width));
    if (kind === "u") view.setUint32(0, value, true);
    else if (width === 4) view.setFloat32(0, value, true);
    else view.setFloat64(0, value, true);
    for (let i = 0; i < width; ++i) this.bytes.push(view.getUint8(i));
    return this;
  }

  get buffer(): ArrayBuffer {
    return Uint8Array.from(this.bytes).buffer;
  }
}

test("a scan's columns come in their order, and those that are missing are not known", () => {
  const bytes = new Bytes().add(4, "u", 2).add(4, "u", 4);
  for (let column = 0; column < 4; ++column) for (let row = 0; row < 2; ++row) bytes.add(4, "f", column * 10 + row + 0.5);
  const scan = decodeScan(bytes.buffer);
  assert.equal(scan.count, 2);
  assert.deepEqual([...scan.columns.x], [0.5, 1.5]);
  assert.deepEqual([...scan.columns.residual_m], [30.5, 31.5]);
  for (const name of SCAN_COLUMNS.slice(4)) assert.ok(scan.columns[name].every(Number.isNaN), name);
});

test("a scan that is cut is refused", () => {
  const bytes = new Bytes().add(4, "u", 2).add(4, "u", 9).add(4, "f", 1);
  assert.throws(() => decodeScan(bytes.buffer), /12 bytes, 80/);
  assert.throws(() => decodeScan(new ArrayBuffer(3)), /header/);
});

test("a series has times in double precision behind a count of four bytes", () => {
  const bytes = new Bytes()
    .add(4, "u", 2)
    .add(8, "f", 1e9 + 0.25)
    .add(8, "f", 1e9 + 0.5);
  for (const value of [1, 2, 3, 4, 5, Number.NaN]) bytes.add(4, "f", value);
  const series = decodeSeries(bytes.buffer);
  assert.deepEqual([...series.time_s], [1e9 + 0.25, 1e9 + 0.5]);
  assert.deepEqual([...series.min], [1, 2]);
  assert.deepEqual([...series.max], [3, 4]);
  assert.equal(series.last[0], 5);
  assert.ok(Number.isNaN(series.last[1]));
});

test("columns of frames: the time is wide, the others are not, whatever comes first", () => {
  const bytes = new Bytes().add(4, "f", 1).add(4, "f", 0).add(4, "f", 1).add(8, "f", 0.1).add(8, "f", 0.2).add(8, "f", 0.3);
  const columns = decodeColumns(bytes.buffer, ["valid", "time_s"], 3);
  assert.deepEqual([...columns.get("valid")!], [1, 0, 1]);
  assert.deepEqual([...columns.get("time_s")!], [0.1, 0.2, 0.3]);
  assert.throws(() => decodeColumns(bytes.buffer, ["time_s"], 3), /were expected/);
});
