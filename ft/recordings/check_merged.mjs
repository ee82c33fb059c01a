// check_merged.mjs FIRST SECOND BOTH: reads what `mdat recording merge` made of two recordings, prefixes a and b, with @mcap/core by its index, and
// compares each pose with that of its own file. Exit codes: 0 the same, 1 not.
import { open } from "node:fs/promises";
import { McapIndexedReader } from "@mcap/core";
import { FileHandleReadable } from "@mcap/nodejs";
import { parse } from "@foxglove/rosmsg";
import { MessageReader } from "@foxglove/rosmsg2-serialization";
import { decompress } from "fzstd";

let findings = 0;

function find(text) {
  findings += 1;
  console.log(`recordings: merged: ${text}`);
}

async function messagesOf(file) {
  const handle = await open(file);
  const reader = await McapIndexedReader.Initialize({
    readable: new FileHandleReadable(handle),
    decompressHandlers: { zstd: (bytes, size) => decompress(bytes, new Uint8Array(Number(size))) },
  });
  const topics = new Map();
  for await (const message of reader.readMessages()) {
    const { topic, schemaId } = reader.channelsById.get(message.channelId);
    const decode = new MessageReader(parse(new TextDecoder().decode(reader.schemasById.get(schemaId).data), { ros2: true }));
    if (!topics.has(topic)) topics.set(topic, []);
    topics.get(topic).push({ time: message.logTime, value: decode.readMessage(message.data) });
  }
  await handle.close();
  return topics;
}

const [first, second, both] = await Promise.all(process.argv.slice(2).map(messagesOf));
for (const [prefix, source] of [["a", first], ["b", second]]) {
  for (const [topic, messages] of source) {
    const merged = both.get(topic === "/tf" ? topic : `/${prefix}${topic}`) ?? [];
    if (topic !== "/tf" && merged.length !== messages.length) find(`${prefix}${topic}: ${merged.length} messages of ${messages.length}`);
  }
  source.get("/pose").forEach(({ value }, i) => {
    const merged = both.get(`/${prefix}/pose`)[i].value;
    if (JSON.stringify(merged.pose) !== JSON.stringify(value.pose)) find(`${prefix}/pose ${i}: another pose`);
    if (merged.header.frame_id !== `${prefix}/sensor`) find(`${prefix}/pose ${i}: its frame is ${merged.header.frame_id}`);
  });
}
const begins = ["a", "b"].map((prefix) => [...both].filter(([topic]) => topic.startsWith(`/${prefix}/`)).map(([, [{ time }]]) => time).reduce((x, y) => (x < y ? x : y)));
if (begins[0] !== begins[1]) find(`they begin at ${begins[0]} and ${begins[1]} ns`);
const parents = new Map(both.get("/tf").flatMap(({ value }) => value.transforms.map((transform) => [transform.child_frame_id, transform.header.frame_id])));
for (const frame of ["a/target", "b/target"]) {
  let root = frame;
  while (parents.has(root)) root = parents.get(root);
  if (root !== "world") find(`/tf: ${frame} hangs on ${root}`);
}
process.exit(findings === 0 ? 0 : 1);
