// What is to be flown: a mission of the list, one of its scenarios, a seed, a pace; and the command that does the same.
import type { LiveMission, LiveScenario } from "../../api/types.ts";
import { shellWord } from "../../parts/shell_word.ts";

const MOST_SEED = 4294967295;

/** The seed that was typed; null: the scenario's own; undefined: it is none. */
export function seedOf(text: string): number | null | undefined {
  if (text.trim() === "") return null;
  const seed = Number(text);
  return Number.isInteger(seed) && seed >= 0 && seed <= MOST_SEED ? seed : undefined;
}

export function commandOf(mission: LiveMission, scenario: string, seed: number | null, pace: number): string {
  const stem = mission.id.replace(/^.*\//, "").replace(/\.toml$/, "");
  const words = ["mdat", "run", mission.file, "--scenario", scenario];
  if (seed !== null) words.push("--seed", String(seed));
  words.push("--record", `${stem}-${scenario}-live.mcap`, "--live", "--pace", String(pace));
  return words.map(shellWord).join(" ");
}

/** The mission that was designed last, which is flown next. */
const designed = { id: "" };

export function setFirstMission(id: string): void {
  designed.id = id;
}

/** The mission to offer first: the one that was designed, or that of the first look, where it is there. */
export function firstMission(missions: LiveMission[]): string {
  if (missions.some((mission) => mission.id === designed.id)) return designed.id;
  return missions.find((mission) => mission.id === "hubble_tenth")?.id ?? missions[0]?.id ?? "";
}

/** The scenario to offer first: "spin" shows the most, else the first that can be watched. */
export function firstScenario(scenarios: Pick<LiveScenario, "name" | "runs">[]): string {
  const watched = scenarios.filter((scenario) => scenario.runs === 1);
  return watched.find((scenario) => scenario.name === "spin")?.name ?? watched[0]?.name ?? "";
}

/** True of what the server connects to: networks and serial devices. */
export function isAddress(text: string): boolean {
  return /^(udp|tcp):\/\/[\d.]*:\d{1,5}$|^serial:\/dev\/\S+$/.test(text);
}

/** The same from the command line. */
export function monitorCommandOf(address: string, mission: LiveMission | undefined): string {
  const words = ["mdat", "monitor", address];
  if (mission !== undefined) words.push("--mission", mission.file);
  const stem = mission === undefined ? "component" : mission.id.replace(/^.*\//, "").replace(/\.toml$/, "");
  words.push("--record", `${stem}-link.mcap`, "--live");
  return words.map(shellWord).join(" ");
}
