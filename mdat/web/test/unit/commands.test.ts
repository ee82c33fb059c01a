import assert from "node:assert/strict";
import { test } from "node:test";
import type { CommandInfo, CommandItem, CommandRecord } from "../../src/api/types.ts";
import { armedBy, commandLine, faultOf, hintOf, isAbout, isForForms, phaseText, valuesOf } from "../../src/views/commands/form.ts";
import { isAddress, monitorCommandOf } from "../../src/views/live/choice.ts";

const item = (changes: Partial<CommandItem>): CommandItem => ({
  name: "x",
  type: "u16",
  count: 1,
  unit: "1",
  minimum: null,
  maximum: null,
  meaning: "",
  ...changes,
});
const command = (changes: Partial<CommandInfo>): CommandInfo => ({ name: "do", meaning: "", hazardous: false, items: [], ...changes });
const record = (changes: Partial<CommandRecord>): CommandRecord => ({
  number: 1,
  name: "do",
  arm: false,
  values: {},
  phase: "executed",
  why: "",
  ...changes,
});

test("a command is found by what can be chosen for its items, too", () => {
  const mode = command({ name: "set_mode", items: [item({ name: "mode", enumeration: "modes", meaning: "from the next boundary on" })] });
  const modes = { modes: [{ value: 9, name: "safe", meaning: "no scans" }] };
  for (const word of ["", "MODE", "safe ", "no scans", "boundary"]) assert.equal(isAbout(mode, modes, word), true, word);
  assert.equal(isAbout(mode, {}, "safe"), false);
  assert.equal(isAbout(mode, modes, "laser"), false);
});

test("a value fits its type and its range, and nothing else does", () => {
  for (const text of ["0", "65535", " 7 "]) assert.equal(faultOf(item({}), text), null, text);
  for (const text of ["", "-1", "65536", "1.5", "seven", "1,2", "Infinity"]) assert.notEqual(faultOf(item({}), text), null, text);
  const angle = item({ type: "f64", minimum: -1, maximum: 1, unit: "rad" });
  for (const text of ["-1", "0.25", "1e-3"]) assert.equal(faultOf(angle, text), null, text);
  for (const text of ["1.01", "nan", "0x"]) assert.notEqual(faultOf(angle, text), null, text);
});

test("an item of several values wants all of them", () => {
  const place = item({ type: "f64", count: 3, unit: "m" });
  assert.equal(faultOf(place, "1, 2, -3.5"), null);
  for (const text of ["1, 2", "1, 2, 3, 4", "1,,3"]) assert.notEqual(faultOf(place, text), null, text);
  assert.equal(hintOf(place), "3 numbers in m, separated by commas");
  assert.equal(hintOf(item({ maximum: 9 })), "whole number from 0 to 9");
});

test("one of an enumeration has to be chosen", () => {
  const mode = item({ enumeration: "mode" });
  assert.equal(faultOf(mode, "safe"), null);
  assert.notEqual(faultOf(mode, ""), null);
});

test("the command line is the one that mdat takes", () => {
  const offer = command({ name: "offer", hazardous: true, items: [item({ name: "p", type: "f64", count: 3 }), item({ name: "mode" })] });
  const values = valuesOf(offer, { p: "1, 2 , 3", mode: "safe" });
  assert.equal(commandLine(offer, {}, "udp://:1"), "mdat command offer p=P mode=MODE --arm --to udp://:1");
  assert.equal(commandLine(offer, values, "udp://127.0.0.1:1"), "mdat command offer p=1,2,3 mode=safe --arm --to udp://127.0.0.1:1");
});

test("a command is armed by its own arm alone, and only until it is fired", () => {
  const arm = record({ number: 1, arm: true });
  assert.equal(armedBy([arm], "do"), arm);
  assert.equal(armedBy([arm], "other"), null);
  assert.equal(armedBy([arm, record({ number: 2 })], "do"), null, "it was fired");
  assert.equal(armedBy([arm, record({ number: 2, name: "other", arm: true })], "do"), null, "another one was armed since");
  assert.equal(armedBy([arm, record({ number: 2, name: "ping" })], "do"), arm);
  assert.equal(armedBy([record({ arm: true, phase: "refused" })], "do"), null);
});

test("what a form is not for is left out", () => {
  assert.ok(isForForms(command({ items: [item({ count: 21 })] })));
  assert.ok(!isForForms(command({ items: [item({ count: 128 })] })));
  assert.ok(!isForForms(command({ name: "arm" })));
});

test("what became of a command is told with its reason", () => {
  assert.equal(phaseText(record({})), "executed");
  assert.equal(phaseText(record({ phase: "refused", why: "bad_argument" })), "refused: bad_argument");
});

test("addresses are those of networks and serial devices", () => {
  for (const text of ["udp://127.0.0.1:5300", "tcp://10.0.0.2:1", "udp://:5300", "serial:/dev/ttyUSB0"]) assert.ok(isAddress(text), text);
  for (const text of ["", "udp://127.0.0.1", "http://127.0.0.1:1", "unix:/run/x", "udp://host:1", "serial:/etc/x"])
    assert.ok(!isAddress(text), text);
  const mission = { id: "a/box.toml", file: "/m/a/box.toml", shipped: false };
  assert.equal(monitorCommandOf("udp://:1", mission), "mdat monitor udp://:1 --mission /m/a/box.toml --record box-link.mcap --live");
  assert.equal(monitorCommandOf("udp://:1", undefined), "mdat monitor udp://:1 --record component-link.mcap --live");
});
