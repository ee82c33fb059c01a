// The form of a mission, made from its JSON Schema: which tables and keys there are, and what may stand there.
import { treeOf } from "./tables.ts";
import type { EffectiveValue, Schema } from "./types.ts";

/** A table of keys: "scan", or one with a chosen name: "scenario.spin". */
export interface Section {
  path: string;
  schema: Schema;
  /** Of a node, below its parents. */
  depth?: number;
}

export interface Field {
  key: string;
  /** Within its section. */
  name: string;
  schema: Schema;
}

/** Schema of a table of chosen names, such as scenario; null of any other. */
export function namedTable(schema: Schema): Schema | null {
  const inner = schema.additionalProperties;
  return typeof inner === "object" && inner.type !== "number" && inner.type !== "string" ? inner : null;
}

/** The names that a text or its values have below a table: [node.chaser] and node.chaser.motion say "chaser". */
export function namesIn(table: string, text: string, values: EffectiveValue[]): string[] {
  const header = new RegExp(`^\\s*\\[${table}\\.(?:"([^"]+)"|([\\w-]+))`, "gm");
  const names = new Set([...text.matchAll(header)].map((match) => match[1] ?? match[2]));
  for (const { key } of values) if (key.startsWith(`${table}.`)) names.add(key.split(".")[1]);
  return [...names];
}

/** All tables of a mission in the order of the schema; of named ones those that are there. */
export function sectionsOf(root: Schema, text: string, values: EffectiveValue[]): Section[] {
  const byKey = new Map(values.map((each) => [each.key, each]));
  return Object.entries(root.properties ?? {}).flatMap(([table, schema]): Section[] => {
    const named = namedTable(schema);
    if (named === null) return [{ path: table, schema, depth: 0 }];
    const names = namesIn(table, text, values);
    const tree = table === "node" ? treeOf(names, byKey) : names.map((name) => ({ name, depth: 0 }));
    return tree.map(({ name, depth }) => ({ path: `${table}.${name}`, schema: named, depth }));
  });
}

/** Tables of chosen names that the form can add to, with what one of them holds. */
export function namedTables(root: Schema): { table: string; schema: Schema }[] {
  return Object.entries(root.properties ?? {}).flatMap(([table, schema]) => {
    const named = namedTable(schema);
    return named === null ? [] : [{ table, schema: named }];
  });
}

/** Of several forms the one whose kind the mission has, or the first. */
function formOf(section: Section, values: Map<string, EffectiveValue>): Schema {
  const { oneOf } = section.schema;
  if (oneOf === undefined || oneOf[0].properties === undefined) return section.schema;
  const kind = values.get(`${section.path}.kind`)?.value.replace(/"/g, "");
  return oneOf.find((form) => form.properties?.kind?.const === kind) ?? oneOf[0];
}

type Values = Map<string, EffectiveValue>;

/** Keys and what stands at them; where names are chosen, under those that have values. */
function membersOf(key: string, schema: Schema, values: Values): [string, Schema][] {
  const { additionalProperties: named } = schema;
  if (schema.properties !== undefined || typeof named !== "object") return Object.entries(schema.properties ?? {});
  const below = [...values.keys()].filter((each) => each.startsWith(`${key}.`)).map((each) => each.slice(key.length + 1).split(".")[0]);
  return [...new Set(below)].map((name) => [name, named]);
}

function fieldsBelow(path: string, prefix: string, schema: Schema, values: Values): Field[] {
  return membersOf(prefix === "" ? path : `${path}.${prefix}`, schema, values).flatMap(([name, inner]): Field[] => {
    const own = prefix === "" ? name : `${prefix}.${name}`;
    return inner.type === "object" ? fieldsBelow(path, own, inner, values) : [{ key: `${path}.${own}`, name: own, schema: inner }];
  });
}

/** The keys of a section that hold a value. Of a scenario's overrides, and of a campaign's flight parameters, those that are written. */
export function fieldsOf(section: Section, values: Values): Field[] {
  const fields = fieldsBelow(section.path, "", formOf(section, values), values);
  return fields.filter(({ key, name }) => !/^(override|mission)\./.test(name) || values.has(key));
}

/** What may stand there, in words. */
export function expectedText(schema: Schema): string {
  const unit = schema["x-unit"] === undefined ? "" : ` ${schema["x-unit"]}`;
  if (schema.const !== undefined) return `"${schema.const}"`;
  if (schema.enum !== undefined) return `one of ${schema.enum.join(", ")}`;
  if (schema.anyOf !== undefined) return schema.anyOf.map(expectedText).join(", or ");
  if (schema.$ref !== undefined) return "a law, such as { uniform = [1, 2] }";
  if (schema.type === "object") return `a table { ${Object.keys(schema.properties ?? {}).join(", ")} = … }`;
  if (schema.type === "boolean") return "true or false";
  if (schema.type === "string") return "a text";
  if (schema.type === "array") return listText(schema, unit);
  if (schema.maximum === undefined) return `a number from ${schema.minimum ?? "any"} on${unit}`;
  return `${schema.type === "integer" ? "a whole number" : "a number"} from ${schema.minimum} to ${schema.maximum}${unit}`;
}

function listText({ minItems, maxItems, items }: Schema, unit: string): string {
  const count = minItems === maxItems ? String(minItems) : `${minItems ?? 1} to ${maxItems ?? "any number"}`;
  if (items?.anyOf !== undefined) return `a list of ${count}, each ${expectedText(items)}`;
  if (items?.minimum === undefined) return `a list of ${count}`;
  return `a list of ${count} numbers, each from ${items.minimum} to ${items.maximum}${unit}`;
}

/** The preset as TOML; "" where there is none. */
export function presetText(schema: Schema): string {
  if (schema.default === undefined) return "";
  if (Array.isArray(schema.default)) return `[${schema.default.join(", ")}]`;
  return schema.enum === undefined ? String(schema.default) : `"${schema.default}"`;
}

/** Fields whose key, meaning or unit holds every word. */
export function fittingFields(fields: Field[], text: string): Field[] {
  const words = text.toLowerCase().split(/\s+/).filter(Boolean);
  return fields.filter(({ key, schema }) => {
    const where = `${key} ${schema.description ?? ""} ${schema["x-unit"] ?? ""}`.toLowerCase();
    return words.every((word) => where.includes(word));
  });
}
