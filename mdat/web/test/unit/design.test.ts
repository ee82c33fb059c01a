import assert from "node:assert/strict";
import { test } from "node:test";
import { changedLines } from "../../src/design/lines.ts";
import { Mission } from "../../src/design/mission.ts";
import { expectedText, fieldsOf, fittingFields, namesIn, presetText, sectionsOf } from "../../src/design/schema.ts";
import { freeName, hasTable, nameProblem, treeOf, withCopy, withoutTable, withTable } from "../../src/design/tables.ts";
import type { EffectiveValue, Schema } from "../../src/design/types.ts";
import { seeded } from "./seeded.ts";

const root: Schema = {
  properties: {
    scan: {
      type: "object",
      properties: {
        points: { type: "integer", minimum: 64, maximum: 4096, default: 1024, description: "rays of one scan" },
        inner: { type: "object", properties: { width: { type: "number", minimum: 0, maximum: 9, "x-unit": "m" } } },
      },
    },
    motion: {
      type: "object",
      additionalProperties: {
        oneOf: [
          { type: "object", properties: { kind: { const: "still" }, position_m: { type: "array", minItems: 3, maxItems: 3 } } },
          { type: "object", properties: { kind: { const: "table" }, file: { type: "string" } } },
        ],
      },
    },
    scenario: {
      type: "object",
      additionalProperties: {
        type: "object",
        properties: {
          frames: { type: "integer", minimum: 1, maximum: 9 },
          override: { type: "object", properties: { gate: { type: "boolean" }, other: { type: "boolean" } } },
        },
      },
    },
  },
};

const value = (key: string, text: string): EffectiveValue => ({ key, value: text, unit: "", place: "m.toml:1", line: 1 });

test("tables with chosen names are those of the text and of the values", () => {
  const text = '[scan]\n[motion.slow]\n  [motion."very fast"]\n[scenario.spin.override]\n';
  assert.deepEqual(namesIn("motion", text, []), ["slow", "very fast"]);
  const sections = sectionsOf(root, text, [value("scenario.paper.frames", "3")]).map(({ path }) => path);
  assert.deepEqual(sections, ["scan", "motion.slow", "motion.very fast", "scenario.spin", "scenario.paper"]);
});

test("a table's form has its keys, of several forms those of its kind, and the overrides that are written", () => {
  const values = new Map(
    [value("motion.slow.kind", '"table"'), value("scenario.spin.override.gate", "true")].map((each) => [each.key, each]),
  );
  const keys = (path: string, name: string) => {
    const inner = root.properties![name].additionalProperties;
    return fieldsOf({ path, schema: typeof inner === "object" ? inner : root.properties![name] }, values).map(({ key }) => key);
  };
  assert.deepEqual(keys("scan", "scan"), ["scan.points", "scan.inner.width"]);
  assert.deepEqual(keys("motion.slow", "motion"), ["motion.slow.kind", "motion.slow.file"]);
  assert.deepEqual(keys("scenario.spin", "scenario"), ["scenario.spin.frames", "scenario.spin.override.gate"]);
});

test("a campaign's form has its laws, its criteria by name, and the flight parameters that are written", () => {
  const law: Schema = { anyOf: [{ type: "number", minimum: 0, maximum: 9 }, { $ref: "#/definitions/law" }] };
  const criterion: Schema = { type: "object", properties: { figure: { enum: ["wrong"] }, at_most: { type: "number" } } };
  const schema: Schema = {
    type: "object",
    properties: {
      cases: { type: "integer" },
      truth: { type: "object", properties: { range_m: law } },
      mission: { type: "object", properties: { start: { type: "object", properties: { share: law, other: law } } } },
      criteria: { type: "object", additionalProperties: criterion },
    },
  };
  const written = ["campaign.a.mission.start.share", "campaign.a.criteria.never.figure", "campaign.b.criteria.other.figure"];
  const fields = fieldsOf({ path: "campaign.a", schema }, new Map(written.map((key) => [key, value(key, "1")])));
  assert.deepEqual(
    fields.map(({ name }) => name),
    ["cases", "truth.range_m", "mission.start.share", "criteria.never.figure", "criteria.never.at_most"],
  );
  assert.equal(expectedText(law), "a number from 0 to 9, or a law, such as { uniform = [1, 2] }");
  assert.equal(expectedText({ type: "array", minItems: 2, maxItems: 2, items: law }), `a list of 2, each ${expectedText(law)}`);
  const anyDirection: Schema = { type: "object", properties: { any_direction: law } };
  assert.equal(expectedText(anyDirection), "a table { any_direction = … }");
});

test("what may stand at a key is said in words, with units", () => {
  assert.equal(expectedText({ type: "integer", minimum: 1, maximum: 9 }), "a whole number from 1 to 9");
  assert.equal(expectedText({ type: "number", minimum: 0, maximum: 2, "x-unit": "m" }), "a number from 0 to 2 m");
  assert.equal(
    expectedText({ type: "array", minItems: 3, maxItems: 3, items: { type: "number", minimum: 0, maximum: 1 }, "x-unit": "deg" }),
    "a list of 3 numbers, each from 0 to 1 deg",
  );
  assert.equal(expectedText({ enum: ["a", "b"] }), "one of a, b");
  assert.equal(presetText({ type: "array", default: [0, 1] }), "[0, 1]");
  assert.equal(presetText({ enum: ["a"], default: "a" }), '"a"');
});

test("keys are found by any words of key, meaning and unit", () => {
  const fields = fieldsOf({ path: "scan", schema: root.properties!.scan }, new Map());
  assert.deepEqual(
    fittingFields(fields, "rays SCAN").map(({ key }) => key),
    ["scan.points"],
  );
  assert.equal(fittingFields(fields, "none").length, 0);
});

test("changed lines make the one text of the other, whatever was changed", () => {
  const random = seeded(11);
  for (let round = 0; round < 200; ++round) {
    const draw = () => Array.from({ length: Math.floor(random() * 8) }, () => "abc"[Math.floor(random() * 3)]);
    const [before, after] = [
      ["top", ...draw(), "end"],
      ["top", ...draw(), "end"],
    ];
    const changes = changedLines(before.join("\n"), after.join("\n"));
    const removed = new Set(changes.filter(({ sign }) => sign === "-").map(({ line }) => line));
    const result = before.filter((_, i) => !removed.has(i + 1));
    for (const { sign, line, text } of changes) if (sign === "+") result.splice(line - 1, 0, text);
    assert.deepEqual(result, after);
  }
});

const TABLES = `# a mission
[scan]
points = 1024

# how it spins
[scenario.spin]   # as it does
frames = [
  1, # [not.a.header]
]
text = """
[scenario.none]
"""

[scenario.spin.override]
gate = true

[scenario."far off"]
frames = 3
`;

test("a table is copied with its comments and all that is below it, and removed again without a trace", () => {
  const copied = withCopy(TABLES, "scenario", "spin", "spin_2");
  const block = TABLES.slice(TABLES.indexOf("# how"), TABLES.indexOf('[scenario."far'));
  assert.equal(
    copied,
    TABLES.replace('[scenario."far', () => `${block.replaceAll("[scenario.spin", "[scenario.spin_2")}[scenario."far`),
  );
  assert.equal(withoutTable(copied, "scenario", "spin_2"), TABLES);
  assert.ok(hasTable(TABLES, "scenario", "far off"));
  assert.ok(!hasTable(TABLES, "scenario", "none"));
  assert.ok(!withoutTable(TABLES, "scenario", "spin").includes("spin"));
  assert.equal(withoutTable(withCopy(TABLES, "scenario", "far off", "near"), "scenario", "near"), TABLES);
});

test("a new table has the keys that it must have; names are plain and free", () => {
  const schema: Schema = {
    required: ["kind", "at", "range_m"],
    properties: {
      kind: { const: "still" },
      at: { type: "array", minItems: 2, items: { minimum: 0.5, maximum: 2 } },
      range_m: { type: "number", minimum: 0, maximum: 9, default: 3 },
    },
  };
  const added = '[scan]\n\n[part.door]\nkind = "still"\nat = [0.5, 0.5]\nrange_m = 3\n';
  assert.equal(withTable("[scan]\n\n\n", "part", "door", schema), added);
  assert.equal(nameProblem("spin_2", ["spin"]), "");
  assert.notEqual(nameProblem("a b", []), "");
  assert.notEqual(nameProblem("spin", ["spin"]), "");
  assert.equal(freeName("spin", ["spin", "spin_2"]), "spin_3");
  assert.equal(freeName("spin_2", ["spin", "spin_2"]), "spin_3");
});

test("nodes stand below their parents, and each is there once, whatever the parents are", () => {
  const names = ["probe", "arrays", "hubble", "chaser", "a", "b"];
  const parents: [string, string][] = [
    ["probe", "chaser"],
    ["arrays", "hubble"],
    ["a", "b"],
    ["b", "a"],
  ];
  const byKey = new Map(parents.map(([name, parent]) => [`node.${name}.parent`, value(`node.${name}.parent`, `"${parent}"`)]));
  const tree = treeOf(names, byKey);
  assert.deepEqual(
    tree.slice(0, 4).map(({ name, depth }) => `${depth} ${name}`),
    ["0 hubble", "1 arrays", "0 chaser", "1 probe"],
  );
  assert.deepEqual(tree.map(({ name }) => name).sort(), [...names].sort());
});

/** A server that sets `KEY = VALUE` lines after a while, and finds no problem. */
async function withSlowServer(run: (mission: Mission) => Promise<void>): Promise<void> {
  const fetched = globalThis.fetch;
  globalThis.fetch = async (_, init) => {
    const asked: { text: string; set?: string[] } = JSON.parse(String(init?.body));
    await new Promise((resolve) => setTimeout(resolve, asked.set === undefined ? 1 : 20));
    const text = (asked.set ?? []).reduce((lines, setting) => {
      const [key, value] = setting.split("=");
      return lines.replace(new RegExp(`^${key} = .*$`, "m"), `${key} = ${value}`);
    }, asked.text);
    return new Response(JSON.stringify({ text, problems: [], values: [] }));
  };
  try {
    const opened = { id: "m", file: "m.toml", shipped: false, digest: "", text: "a = 1\nb = 2\n", problems: [], values: [] };
    await run(new Mission(opened, root));
  } finally {
    globalThis.fetch = fetched;
  }
}

test("values that are set one right behind the other are all kept, and looks at the text between them change nothing", () =>
  withSlowServer(async (mission) => {
    mission.set("a", "7");
    mission.set("b", "8");
    await mission.look();
    await mission.pending;
    assert.equal(mission.text.peek(), "a = 7\nb = 8\n");
    mission.undo(false);
    assert.equal(mission.text.peek(), "a = 7\nb = 2\n");
  }));

test("what is typed while a value is set stays, and the value is set in it", () =>
  withSlowServer(async (mission) => {
    mission.set("a", "7");
    mission.type("# a word\na = 1\nb = 2\n");
    await mission.pending;
    assert.equal(mission.text.peek(), "# a word\na = 7\nb = 2\n");
  }));
