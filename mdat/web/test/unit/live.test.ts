import assert from "node:assert/strict";
import { test } from "node:test";
import type { LiveMission, LiveState, RecordingInfo } from "../../src/api/types.ts";
import { nextPace, PACES } from "../../src/live/feed.ts";
import { type FrameColumns, Log } from "../../src/log/log.ts";
import { horizonOf, Selection } from "../../src/log/selection.ts";
import { commandOf, firstScenario, seedOf } from "../../src/views/live/choice.ts";
import { ageText, isStale, packetsText } from "../../src/views/live/health.ts";
import { seeded } from "./seeded.ts";

function columnsOf(from: number, frames: number): FrameColumns {
  const time_s = Float64Array.from({ length: frames }, (_, i) => 1 + 0.2 * (from + i));
  const number = Float32Array.from(time_s, (_, i) => from + i);
  return {
    time_s,
    number,
    valid: new Float32Array(frames).fill(1),
    wrong: new Float32Array(frames),
    mode: new Float32Array(frames).fill(from),
  };
}

function liveLog(frames: number): Log {
  const log = new Log({ id: "a", frames, start_s: 1, end_s: 2 } as RecordingInfo, columnsOf(0, frames));
  log.live.value = true;
  return log;
}

const state = (changes: Partial<LiveState>): LiveState =>
  ({ phase: "running", paused: false, pace: 1, packets: 50, missing: 0, rate_per_s: 5, age_s: 0, ...changes }) as LiveState;

test("frames that are added follow the ones before, in every column", () => {
  const log = liveLog(5);
  log.append(columnsOf(5, 3));
  assert.equal(log.frames, 8);
  const steps = Array.from(log.columns.time_s.slice(1), (time, i) => time - log.columns.time_s[i]);
  for (const step of steps) assert.ok(Math.abs(step - 0.2) < 1e-9);
  assert.deepEqual(Array.from(log.columns.mode), [0, 0, 0, 0, 0, 5, 5, 5]);
});

test("who is at the newest frame stays there as it grows; who looks back stays where they look", () => {
  const log = liveLog(5);
  const selection = new Selection(log);
  selection.setFrame(4);
  assert.equal(selection.following.peek(), true);
  selection.grow(() => log.append(columnsOf(5, 3)));
  assert.equal(selection.frame.peek(), 7);
  selection.setFrame(2);
  assert.equal(selection.following.peek(), false);
  selection.grow(() => log.append(columnsOf(8, 30)));
  assert.equal(selection.frame.peek(), 2);
  selection.setFrame(37);
  assert.equal(selection.following.peek(), true);
});

test("a recording at its end follows nothing", () => {
  const log = liveLog(5);
  log.live.value = false;
  const selection = new Selection(log);
  selection.setFrame(4);
  assert.equal(selection.following.peek(), false);
});

test("a window that shows all goes on to do so, and one that was chosen stays", () => {
  const log = liveLog(5);
  const selection = new Selection(log);
  for (let from = 5; from < 500; from += 5) selection.grow(() => log.append(columnsOf(from, 5)));
  assert.ok(selection.window.peek().to_s >= log.end_s);
  selection.setWindow({ from_s: 3, to_s: 4 });
  selection.grow(() => log.append(columnsOf(500, 5)));
  assert.deepEqual(selection.window.peek(), { from_s: 3, to_s: 4 });
  selection.setWindow(selection.whole);
  selection.grow(() => {
    log.live.value = false;
  });
  assert.equal(selection.window.peek().to_s, log.end_s);
});

test("the end of a growing time line lies ahead of the data, never behind, and seldom moves", () => {
  const draw = seeded(3);
  for (let i = 0; i < 500; ++i) {
    const from_s = 100 * draw();
    const length_s = 10 ** (4 * draw() - 1);
    const end_s = horizonOf(from_s, from_s + length_s);
    assert.ok(end_s > from_s + length_s);
    assert.ok(end_s - from_s <= 2 * length_s + 5 + 1e-9);
  }
  const ends = new Set(Array.from({ length: 5000 }, (_, i) => horizonOf(0, 0.2 * i)));
  assert.ok(ends.size < 25, String(ends.size));
});

test("a faster pace follows each, up to no limit, and slower ones back", () => {
  let pace = PACES[0];
  for (const next of PACES.slice(1)) {
    pace = nextPace(pace, 1);
    assert.equal(pace, next);
  }
  assert.equal(nextPace(pace, 1), 0);
  assert.equal(nextPace(0, -1), 16);
  assert.equal(nextPace(PACES[0], -1), PACES[0]);
});

test("data are stale when they do not come though they should; at a slow pace they may take longer", () => {
  assert.equal(isStale(state({}), 1), false);
  assert.equal(isStale(state({}), 3.5), true);
  assert.equal(isStale(state({ pace: 0.1 }), 3.5), false);
  assert.equal(isStale(state({ pace: 0.1 }), 11), true);
  assert.equal(isStale(state({ pace: 0 }), 3.5), true);
  assert.equal(isStale(state({ paused: true }), 60), false);
  assert.equal(isStale(state({ phase: "over" }), 60), false);
  assert.equal(isStale(state({}), null), false);
});

test("health is said in words", () => {
  assert.equal(packetsText(state({ rate_per_s: 4.96 })), "5.0 packets/s, none missing");
  assert.equal(packetsText(state({ missing: 3 })), "5.0 packets/s, 3 missing");
  assert.equal(ageText(0.4), "last frame less than 1 s ago");
  assert.equal(ageText(12.7), "last frame 12 s ago");
  assert.equal(ageText(null), "no frame yet");
});

test("a seed is a whole number of 32 bits, or the scenario's", () => {
  assert.equal(seedOf(""), null);
  assert.equal(seedOf(" 17 "), 17);
  assert.equal(seedOf("4294967295"), 4294967295);
  for (const wrong of ["-1", "1.5", "4294967296", "abc"]) assert.equal(seedOf(wrong), undefined, wrong);
});

test("the command flies the same, with words that a shell takes apart quoted", () => {
  const mission: LiveMission = { id: "sub/my own.toml", file: "/data/my own.toml", shipped: false };
  assert.equal(
    commandOf(mission, "spin", 7, 0.5),
    "mdat run '/data/my own.toml' --scenario spin --seed 7 --record 'my own-spin-live.mcap' --live --pace 0.5",
  );
});

test("the scenario that is offered first can be watched", () => {
  const scenario = (name: string, runs: number) => ({ name, runs, frames: 10, seed: 1 });
  assert.equal(firstScenario([scenario("still", 4), scenario("drift", 1), scenario("spin", 1)]), "spin");
  assert.equal(firstScenario([scenario("spin", 4), scenario("drift", 1)]), "drift");
  assert.equal(firstScenario([scenario("still", 4)]), "");
});
