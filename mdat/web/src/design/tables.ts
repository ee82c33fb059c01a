// Tables of chosen names in a mission's text: added, copied and removed as spans of lines, so that everything else stays as it is.
import type { EffectiveValue, Schema } from "./types.ts";

/** Lines [from, to) with the header of a table and what it holds; comments right above it are its own. */
interface Span {
  path: string[];
  from: number;
  header: number;
  to: number;
}

const HEADER = /^\s*\[\[?([^[\]]+)\]\]?\s*(?:#.*)?$/;

/** "scenario", "a.b" of [scenario."a.b"]. */
function partsOf(path: string): string[] {
  return [...path.matchAll(/"([^"]*)"|'([^']*)'|([\w-]+)/g)].map((match) => match[1] ?? match[2] ?? match[3]);
}

/** What a line leaves open: brackets of a list, or a text of several lines. */
interface Open {
  brackets: number;
  text: string;
}

function openAfter(line: string, open: Open): Open {
  let { brackets, text } = open;
  for (const [token] of line.matchAll(/"""|'''|"(?:\\.|[^"\\])*"|'[^']*'|#.*$|[[\]{}]/g)) {
    if (text !== "") text = token === text ? "" : text;
    else if (token === '"""' || token === "'''") text = token;
    else if (token === "[" || token === "{") ++brackets;
    else if (token === "]" || token === "}") --brackets;
  }
  return { brackets: Math.max(0, brackets), text };
}

/** The first of the comments that stand right above a line. */
function withComments(lines: string[], header: number, least: number): number {
  let from = header;
  while (from > least && /^\s*#/.test(lines[from - 1])) --from;
  return from;
}

/** All tables that have a header, in order. */
function spansOf(lines: string[]): Span[] {
  const spans: Span[] = [];
  let open: Open = { brackets: 0, text: "" };
  lines.forEach((line, at) => {
    const match = open.brackets === 0 && open.text === "" ? HEADER.exec(line) : null;
    if (match === null) {
      open = openAfter(line, open);
      return;
    }
    const last = spans.at(-1);
    const from = withComments(lines, at, last === undefined ? 0 : last.header + 1);
    if (last !== undefined) last.to = from;
    spans.push({ path: partsOf(match[1]), from, header: at, to: lines.length });
  });
  return spans;
}

/** Those of table.name, and of the tables below it. */
function spansBelow(lines: string[], table: string, name: string): Span[] {
  return spansOf(lines).filter(({ path }) => path[0] === table && path[1] === name);
}

const isBlank = (line: string | undefined): boolean => line !== undefined && line.trim() === "";

/** Whether the text holds it under headers of its own; otherwise it is changed in the text alone. */
export function hasTable(text: string, table: string, name: string): boolean {
  return spansBelow(text.split("\n"), table, name).length > 0;
}

export function withoutTable(text: string, table: string, name: string): string {
  const lines = text.split("\n");
  for (const { from, to } of spansBelow(lines, table, name).reverse()) lines.splice(from, to - from);
  while (lines.length > 1 && isBlank(lines.at(-1)) && isBlank(lines.at(-2))) lines.pop();
  return lines.join("\n");
}

/** Of a header the name alone is another one: [scenario.spin.override] becomes [scenario.NAME.override]. */
function renamed(header: string, name: string): string {
  return header.replace(/^(\s*\[\[?\s*[\w-]+\s*\.\s*)(?:"[^"]*"|'[^']*'|[\w-]+)/, (_, before: string) => before + name);
}

/** With a copy behind it. */
export function withCopy(text: string, table: string, name: string, copy: string): string {
  const lines = text.split("\n");
  const spans = spansBelow(lines, table, name);
  const block = spans.flatMap(({ from, header, to }) =>
    lines.slice(from, to).map((line, i) => (from + i === header ? renamed(line, copy) : line)),
  );
  while (isBlank(block.at(-1))) block.pop();
  const end = spans.at(-1)!.to;
  const before = isBlank(lines[end - 1]) ? [] : [""];
  lines.splice(end, 0, ...(end === lines.length && before.length === 0 ? ["", ...block] : [...before, ...block, ""]));
  return lines.join("\n");
}

/** A value to begin with: the preset, or the least that may stand there. */
function firstValue(schema: Schema): string {
  const plain = schema.default ?? schema.const ?? schema.enum?.[0] ?? schema.minimum;
  if (plain !== undefined) return JSON.stringify(plain);
  if (schema.type === "array") return `[${Array.from({ length: schema.minItems ?? 1 }, () => firstValue(schema.items ?? {})).join(", ")}]`;
  return schema.type === "string" ? '""' : "0";
}

/** With a new table at the end, which holds the keys that it must have. */
export function withTable(text: string, table: string, name: string, schema: Schema): string {
  const form = schema.oneOf?.[0].properties === undefined ? schema : schema.oneOf[0];
  const keys = (form.required ?? []).map((key) => `${key} = ${firstValue(form.properties?.[key] ?? {})}`);
  return `${[text.replace(/\n+$/, ""), "", `[${table}.${name}]`, ...keys].join("\n")}\n`;
}

/** Why a name cannot be taken; "" where it stands without quotes, and is free. */
export function nameProblem(name: string, taken: string[]): string {
  if (!/^[A-Za-z0-9_-]{1,40}$/.test(name)) return "A name has 1 to 40 letters, digits, _ and -.";
  return taken.includes(name) ? `${name} is there already.` : "";
}

export function freeName(name: string, taken: string[]): string {
  const stem = name.replace(/_\d+$/, "").replace(/[^\w-]+/g, "_");
  let count = 2;
  while (taken.includes(`${stem}_${count}`)) ++count;
  return `${stem}_${count}`;
}

export interface TreeRow {
  name: string;
  depth: number;
}

/** Nodes below their parents. A circle of parents, which is a problem of the text, stands at the end. */
export function treeOf(names: string[], byKey: Map<string, EffectiveValue>): TreeRow[] {
  const parentOf = (name: string) => byKey.get(`node.${name}.parent`)?.value.replace(/"/g, "") ?? "";
  const below = (name: string, depth: number): TreeRow[] => [
    { name, depth },
    ...names.filter((child) => parentOf(child) === name).flatMap((child) => below(child, depth + 1)),
  ];
  const tree = names.filter((name) => !names.includes(parentOf(name))).flatMap((name) => below(name, 0));
  const circles = names.filter((name) => tree.every((row) => row.name !== name));
  return [...tree, ...circles.map((name) => ({ name, depth: 0 }))];
}
