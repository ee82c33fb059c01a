// check.mjs RECORDING PACKETS: reads a recording with @mcap/core, by its index, and decodes each message with Foxglove's CDR reader by the
// definition that the recording holds. What it finds is compared with PACKETS, what `mdat decode --format json` says of the same run's
// telemetry. Exit codes: 0 the same, 1 not.
import { open, readFile } from "node:fs/promises";
import { inflateSync } from "node:zlib";
import { McapIndexedReader } from "@mcap/core";
import { FileHandleReadable } from "@mcap/nodejs";
import { parse } from "@foxglove/rosmsg";
import { MessageReader } from "@foxglove/rosmsg2-serialization";
import { decompress } from "fzstd";

const [recording, packets] = process.argv.slice(2);
const NANOSECONDS = 1_000_000_000n;
const TELEMETRY_ROW = [3, 4, 5, 0, 1, 2]; // of ROS's x, y, z, about x, about y, about z
let findings = 0;

function find(text) {
  findings += 1;
  console.log(`recordings: ${text}`);
}

// Place of a term of the upper triangle, row by row, of a symmetric matrix of six rows.
function term(row, column) {
  const [i, j] = row < column ? [row, column] : [column, row];
  return (i * (13 - i)) / 2 + j - i;
}

function decoders(reader) {
  const made = new Map();
  return (message) => {
    if (!made.has(message.channelId)) {
      const schema = reader.schemasById.get(reader.channelsById.get(message.channelId).schemaId);
      made.set(message.channelId, new MessageReader(parse(new TextDecoder().decode(schema.data), { ros2: true })));
    }
    return made.get(message.channelId).readMessage(message.data);
  };
}

async function read(reader, decode, span = {}) {
  const topics = new Map();
  for await (const message of reader.readMessages(span)) {
    const { topic } = reader.channelsById.get(message.channelId);
    if (!topics.has(topic)) topics.set(topic, []);
    topics.get(topic).push({ time: message.logTime, value: decode(message) });
  }
  return topics;
}

function checkPose(told, { value }) {
  const { position, orientation } = value.pose.pose;
  const pose = [position.x, position.y, position.z, orientation.x, orientation.y, orientation.z, orientation.w];
  const expected = [...told.p_sensor_target_m, ...told.q_sensor_target];
  if (pose.some((number, i) => number !== expected[i])) find(`scan ${told.scan_id}: pose ${pose}, and in telemetry ${expected}`);
  for (let i = 0; i < 36; ++i) {
    const [row, column] = [TELEMETRY_ROW[Math.floor(i / 6)], TELEMETRY_ROW[i % 6]];
    if (value.pose.covariance[i] !== told.covariance[term(row, column)]) find(`scan ${told.scan_id}: term ${i} of its covariance`);
  }
}

// Returns are where their direction and range say, and as many as telemetry says.
function checkScan(told, { value }) {
  const view = new DataView(value.data.buffer, value.data.byteOffset, value.data.byteLength);
  const offset = Object.fromEntries(value.fields.map((field) => [field.name, field.offset]));
  let returns = 0;
  for (let i = 0; i < value.width; ++i) {
    const at = (name) => view.getFloat32(i * value.point_step + offset[name], true);
    if (view.getUint8(i * value.point_step + offset.state) !== 0) continue;
    returns += 1;
    for (const [place, direction] of [["x", "ux"], ["y", "uy"], ["z", "uz"]]) {
      if (at(place) !== Math.fround(at("range") * at(direction))) find(`scan ${told.scan_id}, ray ${i}: ${place}`);
    }
  }
  if (returns !== told.returns) find(`scan ${told.scan_id}: ${returns} returns, and in telemetry ${told.returns}`);
}

// Grey, 8 bits, row by row (the PNG specification, section 9).
function pixelsOf(png) {
  const bytes = Buffer.from(png.buffer, png.byteOffset, png.byteLength);
  const [width, height] = [bytes.readUInt32BE(16), bytes.readUInt32BE(20)];
  const parts = [];
  for (let at = 8; at < bytes.length; at += 12 + bytes.readUInt32BE(at)) {
    if (bytes.toString("latin1", at + 4, at + 8) === "IDAT") parts.push(bytes.subarray(at + 8, at + 8 + bytes.readUInt32BE(at)));
  }
  const data = inflateSync(Buffer.concat(parts));
  const pixels = new Uint8Array(width * height);
  for (let y = 0; y < height; ++y) {
    const filter = data[y * (width + 1)];
    for (let x = 0; x < width; ++x) {
      const left = x > 0 ? pixels[y * width + x - 1] : 0;
      const up = y > 0 ? pixels[(y - 1) * width + x] : 0;
      const corner = x > 0 && y > 0 ? pixels[(y - 1) * width + x - 1] : 0;
      const [p, q, r] = [left, up, corner].map((value) => Math.abs(left + up - corner - value));
      const paeth = p <= q && p <= r ? left : q <= r ? up : corner;
      pixels[y * width + x] = data[y * (width + 1) + 1 + x] + [0, left, up, (left + up) >> 1, paeth][filter];
    }
  }
  return { width, height, pixels };
}

// What the picture shows at each point of a cloud, by the camera's projection.
function seenAt(points, { picture, info }) {
  return points.map((point) => {
    const [u, v, w] = [0, 4, 8].map((row) => info.p.slice(row, row + 4).reduce((sum, term, i) => sum + term * (point[i] ?? 1), 0));
    const [x, y] = [Math.round(u / w), Math.round(v / w)];
    return x < 0 || y < 0 || x >= picture.width || y >= picture.height ? NaN : picture.pixels[y * picture.width + x];
  });
}

function correlation(first, second) {
  const pairs = first.map((a, i) => [a, second[i]]).filter(([a, b]) => !Number.isNaN(a + b));
  const mean = [0, 1].map((k) => pairs.reduce((sum, pair) => sum + pair[k], 0) / pairs.length);
  const product = (j, k) => pairs.reduce((sum, pair) => sum + (pair[j] - mean[j]) * (pair[k] - mean[k]), 0);
  return product(0, 1) / Math.sqrt(product(0, 0) * product(1, 1));
}

function pointsOf({ value }) {
  const view = new DataView(value.data.buffer, value.data.byteOffset, value.data.byteLength);
  const offset = Object.fromEntries(value.fields.map((field) => [field.name, field.offset]));
  const points = Array.from({ length: value.width }, (_, i) => ["x", "y", "z"].map((name) => view.getFloat32(i * value.point_step + offset[name], true)));
  return points.filter(([x]) => !Number.isNaN(x));
}

// Both cameras show a point of the scan alike, each where its own projection says.
function checkPictures() {
  const of = (topic) => new Map((topics.get(topic) ?? []).map(({ time, value }) => [time, value]));
  const [lefts, rights] = ["left", "right"].map((camera) => [of(`/camera/${camera}/image/compressed`), of(`/camera/${camera}/camera_info`)]);
  let compared = 0;
  for (const scan of topics.get("/scan")) {
    if (!lefts[0].has(scan.time)) continue;
    const [left, right] = [lefts, rights].map(([images, infos]) => ({ picture: pixelsOf(images.get(scan.time).data), info: infos.get(scan.time) }));
    if (left.picture.width !== left.info.width || right.picture.height !== right.info.height) find("/camera: a picture of another size than its calibration says");
    const points = pointsOf(scan);
    const same = correlation(seenAt(points, left), seenAt(points, right));
    const astray = correlation(seenAt(points, left), seenAt(points, { ...right, info: left.info }));
    if (!(same > 0.5 && same > astray + 0.2)) find(`/camera, ${scan.time}: both pictures correlate by ${same.toFixed(2)} at the points of the scan`);
    compared += 1;
  }
  if (lefts[0].size !== rights[0].size || (lefts[0].size > 0 && compared === 0)) find(`/camera: ${lefts[0].size} and ${rights[0].size} pictures, ${compared} of scans`);
}

// Each set of frames hangs together from the world down.
function checkFrames({ value }) {
  const parents = new Map(value.transforms.map((transform) => [transform.child_frame_id, transform.header.frame_id]));
  for (const frame of ["sensor", "target", "target_true", "target_filtered"]) {
    let root = frame;
    while (parents.has(root)) root = parents.get(root);
    if (root !== "world") find(`/tf: ${frame} hangs on ${root}`);
  }
}

// Those of a topic's definition, by their names.
function constantsOf(reader, topic) {
  const channel = [...reader.channelsById.values()].find((one) => one.topic === topic);
  if (channel === undefined) return new Map();
  const [{ definitions }] = parse(new TextDecoder().decode(reader.schemasById.get(channel.schemaId).data), { ros2: true });
  return new Map(definitions.filter(({ isConstant }) => isConstant).map(({ name, value }) => [name, value]));
}

function sameNumber(found, expected, constant) {
  if (typeof expected === "string" && constant !== undefined) return found === constant;
  if (typeof found === "bigint") return found === BigInt(expected);
  if (typeof expected === "string") return Object.is(found, { nan: NaN, inf: Infinity, "-inf": -Infinity }[expected]);
  return found === expected || found === Math.fround(expected);
}

// Each packet by its topic: what mdat decode says of it, number by number. A name of an enumeration is a constant of the definition.
function checkPackets(name, expected, messages, constants) {
  if (messages.length !== expected.length) find(`/telemetry/${name}: ${messages.length} messages, and ${expected.length} packets`);
  messages.forEach(({ value }, i) => {
    const { items, header } = expected[i] ?? { items: {}, header: {} };
    if (value.sequence_count !== header.sequence_count) find(`/telemetry/${name}, message ${i}: sequence_count`);
    for (const [item, told] of Object.entries(items)) {
      const found = typeof value[item] === "object" ? [...value[item]] : [value[item]];
      const numbers = Array.isArray(told) ? told : [told];
      const same = numbers.length === found.length
        && numbers.every((number, k) => sameNumber(found[k], number, constants.get(`${item}_${number}`.toUpperCase())));
      if (!same) find(`/telemetry/${name}, message ${i}: ${item} is ${found}, and ${numbers} by mdat decode`);
    }
  });
}

function stamp({ value }) {
  return Number((BigInt(value.header.stamp.sec) * NANOSECONDS + BigInt(value.header.stamp.nanosec)) / 1000n);
}

const reader = await McapIndexedReader.Initialize({
  readable: new FileHandleReadable(await open(recording)),
  decompressHandlers: { zstd: (bytes, size) => decompress(bytes, new Uint8Array(Number(size))) },
});
const decode = decoders(reader);
const topics = await read(reader, decode);
const decoded = JSON.parse(await readFile(packets, "utf8")).packets;
const told = new Map(decoded.filter(({ packet }) => packet === "pose").map(({ items }) => [items.t_measurement_us, items]));
for (const name of new Set(decoded.map(({ packet }) => packet))) {
  checkPackets(name, decoded.filter(({ packet }) => packet === name), topics.get(`/telemetry/${name}`) ?? [], constantsOf(reader, `/telemetry/${name}`));
}
const valid = [...told.values()].filter((items) => items.valid === "yes");
for (const message of topics.get("/pose_with_covariance")) checkPose(told.get(stamp(message)), message);
for (const message of topics.get("/tf")) checkFrames(message);
checkPictures();
for (const message of topics.get("/scan")) checkScan(told.get(stamp(message)), message);
if (topics.get("/pose_with_covariance").length !== valid.length) find(`${topics.get("/pose_with_covariance").length} poses, and ${valid.length} are valid`);

const { messageStartTime, messageEndTime } = reader.statistics;
const span = { startTime: messageStartTime + (messageEndTime - messageStartTime) / 3n, endTime: messageStartTime + (messageEndTime - messageStartTime) / 2n };
const part = await read(reader, decode, span);
for (const [topic, messages] of topics) {
  const within = messages.filter(({ time }) => time >= span.startTime && time <= span.endTime).length;
  if (within !== (part.get(topic) ?? []).length) find(`${topic}: by its index ${(part.get(topic) ?? []).length} messages of a span, not ${within}`);
  console.log(`${topic.padEnd(24)}${String(messages.length).padStart(6)} messages, ${String(within).padStart(5)} of them by seeking`);
}
process.exit(findings === 0 ? 0 : 1);
