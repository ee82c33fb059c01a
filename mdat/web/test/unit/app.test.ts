import assert from "node:assert/strict";
import { test } from "node:test";
import { signal } from "@preact/signals";
import { ApiError, getJson, wasAborted, withQuery } from "../../src/api/client.ts";
import { type Command, History, setting } from "../../src/app/history.ts";
import { strokeOf, strokeParts, takesStroke } from "../../src/app/keys.ts";

const plain = { ctrlKey: false, metaKey: false, altKey: false, shiftKey: false };

test("strokes: Shift counts with letters and arrows, not with signs", () => {
  assert.equal(strokeOf({ ...plain, key: " " }), "Space");
  assert.equal(strokeOf({ ...plain, key: "W", shiftKey: true }), "Shift+w");
  assert.equal(strokeOf({ ...plain, key: "?", shiftKey: true }), "?");
  assert.equal(strokeOf({ ...plain, key: "ArrowLeft", shiftKey: true }), "Shift+ArrowLeft");
  assert.equal(strokeOf({ ...plain, key: "z", metaKey: true }), "Ctrl+z");
});

test("a sign that AltGr writes is that sign, as on a German keyboard", () => {
  const altGraph = (key: string) => key === "AltGraph";
  assert.equal(strokeOf({ ...plain, key: "[", ctrlKey: true, altKey: true, getModifierState: altGraph }), "[");
});

test("strokes are shown by parts, the plus sign too", () => {
  assert.deepEqual(strokeParts("Ctrl+Shift+z"), ["Ctrl", "Shift", "Z"]);
  assert.deepEqual(strokeParts("+"), ["+"]);
  assert.deepEqual(strokeParts("Ctrl+ArrowUp"), ["Ctrl", "↑"]);
});

test("text keeps its strokes, a button only space and Enter", () => {
  const element = (tagName: string, type?: string) => ({ tagName, type, isContentEditable: false });
  assert.equal(takesStroke(element("INPUT", "search"), "w"), true);
  assert.equal(takesStroke(element("INPUT", "checkbox"), "w"), false);
  assert.equal(takesStroke(element("BUTTON"), "Space"), true);
  assert.equal(takesStroke(element("BUTTON"), "ArrowLeft"), false);
  assert.equal(takesStroke(element("DIV"), "Space"), false);
});

test("what was done is undone and done again in order; a new command ends what was undone", () => {
  const history = new History();
  const value = signal(0);
  for (const next of [1, 2, 3]) history.run(setting(`to ${next}`, value, next));
  history.undo();
  history.undo();
  assert.equal(value.value, 1);
  assert.equal(history.canRedo.value, "to 2");
  history.redo();
  assert.equal(value.value, 2);
  history.run(setting("to 9", value, 9));
  assert.equal(history.redo(), null);
  history.undo();
  assert.equal(value.value, 2);
});

test("the history is bounded, and without commands there is nothing to undo", () => {
  const history = new History();
  const nothing: Command = { label: "", apply: () => undefined, revert: () => undefined };
  assert.equal(history.undo(), null);
  for (let i = 0; i < 150; ++i) history.run(nothing);
  let undone = 0;
  while (history.undo() !== null) ++undone;
  assert.equal(undone, 100);
});

test("queries leave out what is empty, and escape the rest", () => {
  assert.equal(withQuery("/a", { filter: "", from: 0, level: undefined }), "/a?from=0");
  assert.equal(withQuery("/a", { filter: "a&b=c" }), "/a?filter=a%26b%3Dc");
  assert.equal(withQuery("/a", {}), "/a");
});

test("a failure and a request that was given up are told apart", () => {
  assert.equal(wasAborted(new DOMException("x", "AbortError")), true);
  assert.equal(wasAborted(new ApiError("a", "b", 500)), false);
});

test("a request given up while the words of a failure are read is no failure", async () => {
  const fetched = globalThis.fetch;
  const cut = new ReadableStream({ start: (body) => body.error(new DOMException("given up", "AbortError")) });
  globalThis.fetch = async () => new Response(cut, { status: 500 });
  try {
    await assert.rejects(getJson("/api/about"), wasAborted);
  } finally {
    globalThis.fetch = fetched;
  }
});
