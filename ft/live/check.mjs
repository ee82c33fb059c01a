// check.mjs MDAT MISSION SCENARIO FRAMES OUT: flies a run with --live, and listens by the official client of the Foxglove WebSocket protocol. Twenty
// clients take everything; one of them is asleep, and one more sends garbage. What they hear is compared with the run's telemetry, as mdat decode
// tells it. Then a run is paused, stepped and resumed. Exit codes: 0 the same, 1 not.
import { spawn, execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import protocol from "@foxglove/ws-protocol";
import { parse } from "@foxglove/rosmsg";
import { MessageReader } from "@foxglove/rosmsg2-serialization";
import { WebSocket } from "ws";

const { FoxgloveClient } = protocol;
const [mdat, mission, scenario, frames, out] = process.argv.slice(2);
const CLIENTS = 20;
const BEGIN = 5;
const NANOSECONDS = 1_000_000_000n;
let findings = 0;

function find(text) {
  findings += 1;
  console.log(`live: ${text}`);
}

// A client that subscribes to every topic, and keeps what it hears by topic: time, arrival and value.
class Listener {
  heard = new Map();
  status = [];
  protocol = "";

  constructor(address, protocols = [FoxgloveClient.SUPPORTED_SUBPROTOCOL]) {
    this.socket = new WebSocket(address, protocols, { perMessageDeflate: false });
    const client = new FoxgloveClient({ ws: this.socket });
    const topics = new Map();
    this.ready = new Promise((resolve) => client.on("advertise", (channels) => {
      for (const channel of channels) {
        const reader = new MessageReader(parse(channel.schema, { ros2: true }));
        topics.set(client.subscribe(channel.id), { topic: channel.topic, reader });
        this.heard.set(channel.topic, []);
      }
      this.protocol = this.socket.protocol;
      resolve();
    }));
    this.closed = new Promise((resolve) => client.on("close", resolve));
    client.on("error", () => {});
    client.on("status", (event) => this.status.push(event));
    client.on("serverInfo", (event) => { this.info = event; });
    client.on("message", ({ subscriptionId, timestamp, data }) => {
      const { topic, reader } = topics.get(subscriptionId);
      this.heard.get(topic).push({ timestamp, arrival: performance.now(), value: reader.readMessage(data) });
    });
  }
}

function start(folder = out) {
  const run = spawn(mdat, ["run", mission, "--scenario", scenario, "--frames", frames, "--no-report", "--force", "--out", folder, "--live", "127.0.0.1:0"]);
  run.stderr.on("data", () => {});
  const ended = new Promise((resolve) => run.on("exit", resolve));
  const address = new Promise((resolve) => run.stdout.on("data", (text) => {
    const found = /live: (ws:\S+)/.exec(text);
    if (found) resolve(found[1]);
  }));
  return { ended, address };
}

// What each viewer must find: numbers to the last bit.
function compare(listener, poses) {
  const byStamp = new Map(poses.map((pose) => [BigInt(pose.t_measurement_us) * 1000n, pose]));
  for (const { timestamp, value } of listener.heard.get("/pose")) {
    const told = byStamp.get(timestamp);
    const { position, orientation } = value.pose;
    const numbers = [position.x, position.y, position.z, orientation.x, orientation.y, orientation.z, orientation.w];
    const expected = told && [...told.p_sensor_target_m, ...told.q_sensor_target];
    if (!expected || numbers.some((number, i) => number !== expected[i])) find(`/pose at ${timestamp}: ${numbers}, telemetry says ${expected}`);
    const stamp = BigInt(value.header.stamp.sec) * NANOSECONDS + BigInt(value.header.stamp.nanosec);
    if (stamp !== timestamp) find(`/pose: header ${stamp}, message ${timestamp}`);
  }
}

// Valid poses from the first one on that this viewer heard: the run waits for nobody who connects.
function since(listener, poses) {
  const first = listener.heard.get("/pose")[0]?.timestamp ?? 0n;
  return poses.filter((pose) => pose.valid === "yes" && BigInt(pose.t_measurement_us) * 1000n >= first).length;
}

// How much later than its time in the run each scan arrived, against the one that was quickest. The first ones come while viewers connect.
function delays(listener) {
  const late = listener.heard.get("/scan").slice(BEGIN).map(({ timestamp, arrival }) => arrival - Number(timestamp) / 1e6);
  const least = Math.min(...late);
  return late.map((value) => value - least);
}

// By the bytes of the protocol's specification: this version of the client has no playback control.
class Controller {
  times = [];
  states = [];

  constructor(address) {
    this.socket = new WebSocket(address, ["foxglove.sdk.v1"], { perMessageDeflate: false });
    this.socket.binaryType = "nodebuffer";
    this.info = new Promise((resolve) => this.socket.on("message", (data, binary) => {
      if (!binary) return JSON.parse(data.toString()).op === "serverInfo" && resolve(JSON.parse(data.toString()));
      if (data[0] === 2) this.times.push(data.readBigUInt64LE(1));
      if (data[0] === 5) this.states.push({ status: data[1], time: data.readBigUInt64LE(2), speed: data.readFloatLE(10), id: data.subarray(19).toString() });
    }));
  }

  async ask(command, speed, seek, id) {
    const bytes = Buffer.alloc(19);
    bytes.writeUInt8(3, 0);
    bytes.writeUInt8(command, 1);
    bytes.writeFloatLE(speed, 2);
    bytes.writeUInt8(seek ? 1 : 0, 6);
    bytes.writeBigUInt64LE(seek, 7);
    bytes.writeUInt32LE(id.length, 15);
    this.socket.send(Buffer.concat([bytes, Buffer.from(id)]));
    await until(() => this.states.some((state) => state.id === id));
    return this.states.find((state) => state.id === id);
  }
}

const pause = (milliseconds) => new Promise((resolve) => setTimeout(resolve, milliseconds));

async function until(condition) {
  for (let i = 0; i < 500 && !condition(); ++i) await pause(20);
  if (!condition()) find(`waited 10 s in vain: ${condition}`);
}

// Pauses, goes on by one frame, tries to go back, resumes a hundred times as fast. The results are those of a run that nobody touched.
async function checkPlayback(untouched) {
  const [PLAY, PAUSE, FRAME] = [0, 1, 200_000_000n];
  const folder = `${out}-paused`;
  const { ended, address } = start(folder);
  const viewer = new Controller(await address);
  const info = await viewer.info;
  if (!info.capabilities.includes("playbackControl") || !(info.dataEndTime.sec > info.dataStartTime.sec)) find(`playback is not offered: ${JSON.stringify(info)}`);
  await until(() => viewer.times.length > 2);
  if ((await viewer.ask(PAUSE, 1, 0n, "pause")).status !== 1) find("a pause is not told");
  await pause(300);
  const stood = viewer.times.at(-1);
  await pause(600);
  if (viewer.times.at(-1) !== stood) find("a paused run goes on");
  await viewer.ask(PAUSE, 1, stood + FRAME, "step");
  await until(() => viewer.times.at(-1) > stood);
  await pause(600);
  if (viewer.times.at(-1) > stood + 2n * FRAME) find(`a step of a frame went from ${stood} to ${viewer.times.at(-1)}`);
  const back = await viewer.ask(PAUSE, 1, 1n, "back");
  if (back.time < stood) find(`it went back to ${back.time}`);
  const resumed = await viewer.ask(PLAY, 100, 0n, "play");
  if (resumed.status !== 0 || resumed.speed !== 100) find(`resumed: ${JSON.stringify(resumed.speed)}`);
  if ((await ended) !== 0) find("the run that was paused failed");
  if (viewer.states.at(-1).status !== 3) find("the end is not told");
  if (!readFileSync(`${folder}/telemetry.ccsds`).equals(readFileSync(`${untouched}/telemetry.ccsds`))) find("a pause changed the run");
}

const { ended, address } = start();
const place = await address;
const listeners = Array.from({ length: CLIENTS }, (_, i) => new Listener(place, [i % 2 ? "foxglove.sdk.v1" : "foxglove.websocket.v1"]));
await Promise.all(listeners.map((listener) => listener.ready));
listeners[0].socket._socket.pause(); // asleep: takes nothing more off its line
const rude = new Listener(place);
await rude.ready;
for (const text of ["", "{", "[1]", '{"op":7}', '{"op":"advertise","channels":[]}', '{"op":"subscribe","subscriptions":[{"id":-1,"channelId":1e99}]}'])
  rude.socket.send(text);
rude.socket.send(Buffer.alloc(70000, 7));
const stranger = new WebSocket(place, ["some.other.v1"]);
const refused = await new Promise((resolve) => { stranger.on("unexpected-response", (_, response) => resolve(response.statusCode)); stranger.on("error", () => resolve(0)); });
if (refused !== 400) find(`a client with another subprotocol is answered ${refused}, expected 400`);
if ((await ended) !== 0) find("the run failed");
await Promise.all(listeners.slice(1).map((listener) => listener.closed));

const decoded = JSON.parse(execFileSync(mdat, ["decode", `${out}/telemetry.ccsds`, "--format", "json"], { maxBuffer: 1 << 30 })).packets;
const poses = decoded.filter(({ packet }) => packet === "pose").map(({ items }) => items);
const events = new Set(decoded.map(({ header, offset }) => header.service === 5 && header.subservice <= 4 && offset)).size - 1;
const valid = poses.filter(({ valid: word }) => word === "yes").length;
for (const [i, listener] of listeners.entries()) {
  if (i === 0) continue;
  compare(listener, poses);
  const counts = Object.fromEntries([...listener.heard].map(([topic, messages]) => [topic, messages.length]));
  if (counts["/scene"] !== 1) find(`client ${i}: /scene came ${counts["/scene"]} times, expected once`);
  if (counts["/pose"] !== since(listener, poses)) find(`client ${i}: ${counts["/pose"]} poses, telemetry has ${since(listener, poses)} since its first`);
  if (counts["/pose"] < valid - BEGIN) find(`client ${i}: ${counts["/pose"]} poses, telemetry has ${valid}`);
  if (counts["/events"] !== events) find(`client ${i}: ${counts["/events"]} events, telemetry has ${events}`);
  if ("/sensor_scans" in counts) find(`client ${i}: /sensor_scans is told`);
  if (!listener.status.some(({ message }) => message === "the run is over")) find(`client ${i}: is not told that the run is over`);
}
if (listeners[1].protocol !== "foxglove.sdk.v1" || listeners[2].protocol !== "foxglove.websocket.v1") find("a subprotocol that was offered is not taken");
await checkPlayback(out);
const complaints = rude.status.filter(({ level }) => level === 2).length;
if (complaints !== 7) find(`garbage was answered ${complaints} times, expected 7`);
const late = listeners.slice(1).flatMap(delays).sort((a, b) => a - b);
console.log(`live: ${findings === 0 ? "passed" : "FAILED"} (${CLIENTS - 1} clients awake, one asleep, one rude: ${valid} poses of ${poses.length} frames; ` +
  `delay of scans median ${late[late.length >> 1].toFixed(1)} ms, 95 % within ${late[Math.floor(0.95 * late.length)].toFixed(1)} ms)`);
process.exit(findings === 0 ? 0 : 1);
