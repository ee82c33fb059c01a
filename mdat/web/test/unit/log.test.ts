import assert from "node:assert/strict";
import { test } from "node:test";
import type { RecordingInfo } from "../../src/api/types.ts";
import { Cache } from "../../src/log/cache.ts";
import { Events } from "../../src/log/events.ts";
import { lastNotAbove, nextIndex, runsOf, verdictOf } from "../../src/log/frames.ts";
import { type FrameColumns, Log } from "../../src/log/log.ts";
import { Player } from "../../src/log/player.ts";
import { orderedSpan, Selection } from "../../src/log/selection.ts";
import { seeded } from "./seeded.ts";

/** A log of frames every 0.2 s from 1 s on. */
function logOf(frames: number): Log {
  const time_s = Float64Array.from({ length: frames }, (_, i) => 1 + 0.2 * i);
  const zeros = () => new Float32Array(frames);
  const columns: FrameColumns = { time_s, number: zeros().map((_, i) => i), valid: zeros().fill(1), wrong: zeros(), mode: zeros() };
  return new Log({ id: "a", frames, start_s: 1, end_s: 1 + 0.2 * frames } as RecordingInfo, columns);
}

test("the frame at a time is the last that is not after it", () => {
  const draw = seeded(7);
  const times = Float64Array.from({ length: 300 }, () => Math.floor(1000 * draw()) / 10).sort();
  for (let i = 0; i < 400; ++i) {
    const time = Math.floor(1100 * draw()) / 10 - 5;
    const brute = times.filter((each) => each <= time).length - 1;
    assert.equal(lastNotAbove(times, time), Math.max(0, brute));
  }
  assert.equal(lastNotAbove(new Float64Array(), 3), 0);
});

test("a frame is found by the number that its run gave it; one that was not told by the frame before", () => {
  const log = logOf(6);
  log.columns.number.set([0, 1, 2, 5, 6, 9]);
  assert.deepEqual(
    [0, 3, 5].map((index) => log.number(index)),
    [0, 5, 9],
  );
  assert.deepEqual(
    [-1, 0, 2, 4, 5, 8, 9, 40].map((number) => log.withNumber(number)),
    [0, 0, 2, 2, 3, 4, 5, 5],
  );
});

test("the next index that fits lies strictly beyond, in either direction", () => {
  const fits = (i: number) => i % 7 === 3;
  assert.equal(nextIndex(30, 3, 1, fits), 10);
  assert.equal(nextIndex(30, 10, -1, fits), 3);
  assert.equal(nextIndex(30, 3, -1, fits), -1);
  assert.equal(nextIndex(30, 24, 1, fits), -1);
});

test("runs cover each index once, with equal neighbours together, not known ones too", () => {
  const column = Float32Array.from([1, 1, Number.NaN, Number.NaN, 0, 1]);
  const runs = runsOf(column);
  assert.deepEqual(
    runs.map(({ first, last }) => [first, last]),
    [
      [0, 1],
      [2, 3],
      [4, 4],
      [5, 5],
    ],
  );
});

test("a pose that is not valid was refused, whatever the truth says; of an unknown truth none is wrong", () => {
  assert.equal(verdictOf(0, 1), "refused");
  assert.equal(verdictOf(1, 1), "wrong");
  assert.equal(verdictOf(1, 0), "valid");
  assert.equal(verdictOf(1, Number.NaN), "valid");
  assert.equal(verdictOf(Number.NaN, Number.NaN), "unknown");
});

test("a span has its ends in order and within the recording", () => {
  assert.deepEqual(orderedSpan(9, -4, { from_s: 0, to_s: 5 }), { from_s: 0, to_s: 5 });
  assert.deepEqual(orderedSpan(3, 2, { from_s: 0, to_s: 5 }), { from_s: 2, to_s: 3 });
});

test("zooming keeps the time under the cursor where it is, and the window within the recording", () => {
  const selection = new Selection(logOf(101));
  selection.zoom(0.25, 9);
  const { from_s, to_s } = selection.window.value;
  assert.ok(Math.abs((9 - from_s) / (to_s - from_s) - (9 - 1) / 20) < 1e-9);
  selection.zoom(1000, 9);
  assert.deepEqual(selection.window.value, selection.whole);
  selection.zoom(0.1, 9);
  selection.pan(100);
  assert.ok(Math.abs(selection.window.value.to_s - 21) < 1e-9);
});

test("the window follows the time when it leaves it", () => {
  const selection = new Selection(logOf(101));
  selection.setWindow({ from_s: 2, to_s: 4 });
  selection.setTime(15);
  const { from_s, to_s } = selection.window.value;
  assert.ok(from_s <= 15 && 15 <= to_s);
  assert.ok(Math.abs(to_s - from_s - 2) < 1e-9);
});

test("a new frame shows its result, not an iteration of the frame before", () => {
  const selection = new Selection(logOf(10));
  selection.iteration.value = 2;
  selection.setTime(selection.time_s.value + 0.01);
  assert.equal(selection.iteration.value, 2);
  selection.setFrame(4);
  assert.equal(selection.iteration.value, null);
});

test("playing moves by the clock, the speed and the direction, and stops at the ends", () => {
  const selection = new Selection(logOf(51));
  const player = new Player(selection);
  player.play(1);
  player.speed.value = 2;
  player.advance(1.5);
  assert.ok(Math.abs(selection.time_s.value - 4) < 1e-9);
  player.play(-1);
  player.advance(0.5);
  assert.ok(Math.abs(selection.time_s.value - 3) < 1e-9);
  player.advance(100);
  assert.equal(selection.time_s.value, 1);
  assert.equal(player.playing.value, false);
  player.play(-1);
  assert.equal(selection.frame.value, 50, "in reverse from the start it begins at the end");
});

test("a looped span is played again and again, either way", () => {
  const selection = new Selection(logOf(51));
  const player = new Player(selection);
  selection.setSpan({ from_s: 3, to_s: 5 });
  selection.loop.value = true;
  player.play(1);
  assert.equal(selection.time_s.value, 3);
  player.advance(1.9);
  player.advance(0.2);
  assert.equal(selection.time_s.value, 3);
  player.play(-1);
  player.advance(0.1);
  player.advance(0.1);
  assert.ok(selection.time_s.value <= 5 && selection.time_s.value > 4.5);
  assert.equal(player.playing.value, true);
});

test("J and L play, and each further stroke is faster", () => {
  const player = new Player(new Selection(logOf(51)));
  player.shuttle(1);
  assert.equal(player.speed.value, 1);
  player.shuttle(1);
  player.shuttle(1);
  assert.equal(player.speed.value, 4);
  player.shuttle(-1);
  assert.deepEqual([player.speed.value, player.direction.value], [1, -1]);
});

test("steps pause, and end at the first and last frame", () => {
  const selection = new Selection(logOf(12));
  const player = new Player(selection);
  player.play(1);
  player.step(10);
  assert.deepEqual([selection.frame.value, player.playing.value], [10, false]);
  player.step(10);
  assert.equal(selection.frame.value, 11);
  player.step(-100);
  assert.equal(selection.frame.value, 0);
});

test("each frame's own time selects it", () => {
  const selection = new Selection(logOf(997));
  for (let frame = 0; frame < 997; ++frame) {
    selection.setFrame(frame);
    assert.equal(selection.frame.value, frame);
  }
});

test("a recording without frames can be looked at, and played without harm", () => {
  const selection = new Selection(logOf(0));
  const player = new Player(selection);
  player.toggle();
  player.step(1);
  assert.equal(player.playing.value, false);
  assert.equal(selection.frame.value, 0);
});

test("events are found before and after a frame, not at it", () => {
  const events = new Events();
  events.all.value = [2, 5, 5, 9].map((frame) => ({ time_s: frame, frame, level: "info" as const, name: `at ${frame}`, text: "" }));
  assert.equal(events.next(5, 1)?.frame, 9);
  assert.equal(events.next(5, -1)?.frame, 2);
  assert.equal(events.next(9, 1), null);
});

test("the cache forgets what was used longest ago, and what failed", async () => {
  const cache = new Cache<number>(2);
  let made = 0;
  const make = () => Promise.resolve(++made);
  await cache.get("a", make);
  await cache.get("b", make);
  await cache.get("a", make);
  await cache.get("c", make);
  assert.equal(await cache.get("a", make), 1);
  assert.equal(await cache.get("b", make), 4);
  await assert.rejects(cache.get("d", () => Promise.reject(new Error("no"))));
  assert.equal(await cache.get("d", make), 5);
});
