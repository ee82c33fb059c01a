// What is typed into the form of a command: whether it fits the dictionary, and the command line that does the same.
import type { CommandInfo, CommandItem, CommandList, CommandRecord } from "../../api/types.ts";
import { unitText } from "../../api/units.ts";
import { shellWord } from "../../parts/shell_word.ts";

/** Whole numbers that a type holds. */
const WHOLE: Partial<Record<CommandItem["type"], [number, number]>> = {
  u8: [0, 255],
  u16: [0, 65535],
  u32: [0, 4294967295],
  i64: [Number.MIN_SAFE_INTEGER, Number.MAX_SAFE_INTEGER],
};
/** More values are nothing for a form: they come from files, as images do. */
const MOST_VALUES = 32;
/** Between arm and fire, as the component counts it. */
export const ARMED_S = 10;

/** Not `arm`, which the form of each hazardous command has as its first button. */
export function isForForms(command: CommandInfo): boolean {
  return command.name !== "arm" && command.items.every((item) => item.count <= MOST_VALUES);
}

/** Whether a command has to do with a word: its name and meaning, and those of its items and of what can be chosen for them. */
export function isAbout({ name, meaning, items }: CommandInfo, enumerations: CommandList["enumerations"], word: string): boolean {
  const choices = items.flatMap(({ enumeration }) => enumerations[enumeration ?? ""] ?? []);
  const words = [{ name, meaning }, ...items, ...choices].map((each) => `${each.name} ${each.meaning}`);
  return words.some((text) => text.toLowerCase().includes(word.trim().toLowerCase()));
}

export function rangeOf(item: CommandItem): [number, number] {
  const [least, most] = WHOLE[item.type] ?? [Number.NEGATIVE_INFINITY, Number.POSITIVE_INFINITY];
  return [Math.max(least, item.minimum ?? least), Math.min(most, item.maximum ?? most)];
}

/** As people write it; several units are those of rows, in their order. */
export function unitOf(item: CommandItem): string {
  return unitText(item.unit).replace(/,/g, ", ");
}

/** What an item takes, in words. */
export function hintOf(item: CommandItem): string {
  const [least, most] = rangeOf(item);
  const unit = unitOf(item);
  const kind = item.type in WHOLE ? "whole number" : "number";
  const many = item.count > 1 ? `${item.count} ${kind}s` : kind;
  const bounds = [least > -1e15 ? `from ${least}` : "", most < 1e15 ? `to ${most}` : ""].filter(Boolean).join(" ");
  const what = [many, bounds, unit === "" ? "" : `in ${unit}`].filter(Boolean).join(" ");
  return item.count > 1 ? `${what}, separated by commas` : what;
}

function isFitting(item: CommandItem, text: string): boolean {
  const value = Number(text);
  const [least, most] = rangeOf(item);
  if (text.trim() === "" || !Number.isFinite(value) || value < least || value > most) return false;
  return !(item.type in WHOLE) || Number.isInteger(value);
}

/** Why a text is no value of the item; null: it is one. */
export function faultOf(item: CommandItem, text: string): string | null {
  if (item.enumeration !== undefined && item.count === 1) return text === "" ? "choose one" : null;
  const values = text.split(",");
  if (values.length === item.count && values.every((value) => isFitting(item, value))) return null;
  return `expected: ${hintOf(item)}`;
}

/** Values as the server and mdat command take them: without blanks. */
export function valuesOf(command: CommandInfo, texts: Record<string, string>): Record<string, string> {
  return Object.fromEntries(command.items.map(({ name }) => [name, (texts[name] ?? "").replace(/\s/g, "")]));
}

/** The same from the command line; what is missing stands there in capitals. */
export function commandLine(command: CommandInfo, values: Record<string, string>, address: string): string {
  const words = ["mdat", "command", command.name, ...command.items.map(({ name }) => `${name}=${values[name] || name.toUpperCase()}`)];
  if (command.hazardous) words.push("--arm");
  words.push("--to", address);
  return words.map(shellWord).join(" ");
}

const PHASES: Record<CommandRecord["phase"], string> = {
  waiting: "waits to be sent",
  sent: "sent",
  accepted: "accepted",
  executed: "executed",
  failed: "accepted, but not carried out",
  refused: "refused",
  unanswered: "not answered",
  not_sent: "not sent",
};

export function phaseText({ phase, why }: CommandRecord): string {
  return why === "" ? PHASES[phase] : `${PHASES[phase]}: ${why}`;
}

/** The record that armed this command, if nothing has used that up; later ones of the same command have. */
export function armedBy(records: CommandRecord[], name: string): CommandRecord | null {
  const last = records.filter((record) => record.arm || record.name === name).at(-1);
  return last?.arm === true && last.name === name && last.phase === "executed" ? last : null;
}
