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

/** Starts mdat serve and gives its address, which is the first line that it prints. */
function serve(folder: string): Promise<{ address: string; process: ChildProcess }> {
  const child = spawn(MDAT, ["serve", folder, "--port", "0"], { cwd: TOP, stdio: ["ignore", "pipe", "ignore"] });
  return new Promise((done, failed) => {
    child.once("exit", (code) => failed(new Error(`mdat serve ended with ${code}`)));
    createInterface({ input: child.stdout! }).once("line", (address) => done({ address, process: child }));
  });
}

export default async function setUp(): Promise<() => void> {
  const recordings = join(OUT, "recordings");
  const empty = join(OUT, "empty");
  makeRecordings(recordings);
  rmSync(empty, { recursive: true, force: true });
  mkdirSync(empty, { recursive: true });
  const live = join(OUT, "live");
  rmSync(live, { recursive: true, force: true });
  mkdirSync(live, { recursive: true });
  const meshes = join(OUT, "meshes");
  rmSync(meshes, { recursive: true, force: true });
  mkdirSync(meshes, { recursive: true });
  const servers = [await serve(recordings), await serve(empty), await serve(live), await serve(meshes)];
  process.env.PAGE_ADDRESS = servers[0].address;
  process.env.PAGE_EMPTY_ADDRESS = servers[1].address;
  process.env.PAGE_LIVE_ADDRESS = servers[2].address;
  process.env.PAGE_LIVE_FOLDER = live;
  process.env.PAGE_MESH_ADDRESS = servers[3].address;
  process.env.PAGE_MESH_FOLDER = meshes;
  process.env.PAGE_LIVE_PID = String(servers[2].process.pid);
  return () => {
    for (const server of servers) server.process.kill("SIGINT");
  };
}
