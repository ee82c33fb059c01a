// Before all tests: flies three short runs, records them, and starts mdat serve on them and on three empty folders. Ends all after the tests.
import { type ChildProcess, execFileSync, spawn } from "node:child_process";
import { copyFileSync, mkdirSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { createInterface } from "node:readline";
import { fileURLToPath } from "node:url";

const TOP = resolve(fileURLToPath(new URL("../../../..", import.meta.url)));
const MDAT = resolve(process.env.MDAT ?? join(TOP, "out/build/mdat/mdat"));
const OUT = process.env.PAGE_OUT ?? join(TOP, "out/page");
const MISSION = join(TOP, "cfg/missions/hubble_tenth.toml");

/** A start that is half a turn off, and gates that let it pass: valid poses that are wrong, and some that are refused. */
const TURNED = [
  "scenario.spin.prior_turn_deg=[180.0,0.0,0.0]",
  "start.inlier_share_min=0.3",
  "tracking.agreement_min=0.0",
  "tracking.inlier_share_min=0.2",
];

function fly(file: string, scenario: string, frames: number, settings: string[] = []): void {
  const set = settings.flatMap((each) => ["--set", each]);
  const options = ["--frames", String(frames), "--no-report", "--force", "--out", join(OUT, "run"), "--record", file, ...set];
  execFileSync(MDAT, ["run", MISSION, "--scenario", scenario, ...options], { cwd: TOP, stdio: "ignore" });
}

function makeRecordings(folder: string): void {
  rmSync(folder, { recursive: true, force: true });
  mkdirSync(folder, { recursive: true });
  fly(join(folder, "spin.mcap"), "spin", 100);
  fly(join(folder, "turned.mcap"), "spin", 60, TURNED);
  fly(join(folder, "checked.mcap"), "checked", 40);
  writeFileSync(join(folder, "letter.mcap"), "Dear reader, this is no recording.\n");
  copyFileSync(join(folder, "spin.mcap"), join(folder, "cut.mcap"));
  const whole = readFileSync(join(folder, "spin.mcap"));
  writeFileSync(join(folder, "cut.mcap"), whole.subarray(0, Math.floor(0.6 * statSync(join(folder, "spin.mcap")).size)));
}

export interface Started {
  process: ChildProcess;
  /** The first line that it prints. */
  line: string;
}

/** Starts mdat, and waits for its first line. */
export function start(words: string[]): Promise<Started> {
  const child = spawn(MDAT, words, { cwd: TOP, stdio: ["ignore", "pipe", "ignore"] });
  return new Promise((done, failed) => {
    child.once("exit", (code) => failed(new Error(`mdat ${words[0]} ended with ${code}`)));
    createInterface({ input: child.stdout! }).once("line", (line) => done({ line, process: child }));
  });
}

/** A folder below what the tests leave, with nothing in it. */
export function emptyFolder(name: string): string {
  const folder = join(OUT, name);
  rmSync(folder, { recursive: true, force: true });
  mkdirSync(folder, { recursive: true });
  return folder;
}

/** Starts mdat serve: its line is the address. */
export const serve = (folder: string, more: string[] = []): Promise<Started> => start(["serve", folder, "--port", "0", ...more]);

/** A component behind a link, in real time: its line says where. */
export const flyLinked = (out: string): Promise<Started> =>
  start(["run", MISSION, "--scenario", "spin", "--frames", "5000", "--no-report", "--force", "--out", out, "--link", "udp://:0"]);

export default async function setUp(): Promise<() => void> {
  const recordings = join(OUT, "recordings");
  makeRecordings(recordings);
  const live = emptyFolder("live");
  const meshes = emptyFolder("meshes");
  const servers = [await serve(recordings), await serve(emptyFolder("empty")), await serve(live), await serve(meshes)];
  process.env.PAGE_ADDRESS = servers[0].line;
  process.env.PAGE_EMPTY_ADDRESS = servers[1].line;
  process.env.PAGE_LIVE_ADDRESS = servers[2].line;
  process.env.PAGE_LIVE_FOLDER = live;
  process.env.PAGE_MESH_ADDRESS = servers[3].line;
  process.env.PAGE_MESH_FOLDER = meshes;
  process.env.PAGE_LIVE_PID = String(servers[2].process.pid);
  return () => {
    for (const server of servers) server.process.kill("SIGINT");
  };
}
