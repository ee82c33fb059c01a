import assert from "node:assert/strict";
import { test } from "node:test";
import { Mission } from "../../src/design/mission.ts";
import { Preview } from "../../src/design/preview.ts";

test("the surface is that of the scan that is shown, though the text may have a problem by now", async () => {
  const fetched = globalThis.fetch;
  const asked: { path: string; text: string }[] = [];
  globalThis.fetch = async (path, init) => {
    const { text } = JSON.parse(String(init?.body)) as { text: string };
    asked.push({ path: String(path).split("?")[0], text });
    return new Response(JSON.stringify(text === "good" ? { surface: "digest" } : { problem: "bad" }));
  };
  try {
    const opened = { id: "m", file: "m.toml", shipped: false, digest: "", text: "good", problems: [], values: [] };
    const mission = new Mission(opened, {});
    const preview = new Preview(mission, "spin");
    const end = preview.follow();
    const shown = new Promise<void>((resolve) => preview.shown.subscribe((answer) => answer !== null && resolve()));
    await shown;
    mission.text.value = "bad";
    await preview.surface();
    end();
    assert.deepEqual(asked, [
      { path: "/api/mission/preview", text: "good" },
      { path: "/api/mission/surface", text: "good" },
    ]);
  } finally {
    globalThis.fetch = fetched;
  }
});
