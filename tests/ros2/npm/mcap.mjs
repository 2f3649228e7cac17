// MCAP files against @mcap/core: ours read by it, its own read by us.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import test from "node:test";
import zstd from "@foxglove/wasm-zstd";
import { MessageReader, MessageWriter } from "@foxglove/rosmsg2-serialization";
import { McapIndexedReader, McapStreamReader, McapWriter } from "@mcap/core";
import { loadDecompressHandlers } from "@mcap/support";
import { angle, definitions, fieldsOf, folder, heading, length, ortung, parseSchema, record, source } from "./common.mjs";

const decompressHandlers = await loadDecompressHandlers();
await zstd.isLoaded;
const near = (a, b, limit = 1e-9) => assert.ok(Math.abs(a - b) <= limit, `${a} is not ${b}`);

async function readIndexed(file) {
  const bytes = readFileSync(file);
  const readable = {
    size: async () => BigInt(bytes.length),
    read: async (from, size) => new Uint8Array(bytes.buffer, bytes.byteOffset + Number(from), Number(size)),
  };
  const reader = await McapIndexedReader.Initialize({ readable, decompressHandlers });
  const messages = [];
  const readers = new Map();
  for await (const message of reader.readMessages({ validateCrcs: true })) {
    const channel = reader.channelsById.get(message.channelId);
    const schema = reader.schemasById.get(channel.schemaId);
    if (!readers.has(schema.id)) {
      assert.equal(schema.encoding, "ros2msg");
      readers.set(schema.id, new MessageReader(parseSchema(new TextDecoder().decode(schema.data))));
    }
    const value = readers.get(schema.id).readMessage(message.data);
    messages.push({ topic: channel.topic, time: Number(message.logTime / 1000n), value });
  }
  return { reader, messages, bytes };
}

test("@mcap/core reads what is exported, by its index and front to back, with the record's numbers", async (t) => {
  const at = folder(t);
  ortung("sim", `${source}/maps/fields/f2000.toml`, "--robot", `${source}/maps/robots/pioneer.toml`, "--duration", "5", "--free-run", "--record", at("run.txt"));
  ortung("export", "mcap", `record:${at("run.txt")}`, "--robot", `${source}/maps/robots/pioneer.toml`, "--world", `${source}/maps/fields/f2000.toml`, "--out", at("run.mcap"));
  const { reader, messages, bytes } = await readIndexed(at("run.mcap"));
  assert.equal(reader.header.profile, "ros2");
  assert.equal(Number(reader.statistics.messageCount), messages.length);
  assert.ok(reader.chunkIndexes.length >= 1);

  const stream = new McapStreamReader({ decompressHandlers, validateCrcs: true });
  stream.append(bytes);
  let count = 0;
  for (let one; (one = stream.nextRecord()); ) count += one.type === "Message" ? 1 : 0;
  assert.ok(stream.done());
  assert.equal(count, messages.length);

  const readings = record(at("run.txt"));
  const of = (topic) => messages.filter((message) => message.topic === topic);
  const compare = (topic, id, check) => {
    const ours = of(topic);
    const theirs = readings.filter((reading) => reading.id === id);
    assert.ok(theirs.length > 40, `${theirs.length} of ${id}`);
    assert.equal(ours.length, theirs.length, topic);
    ours.forEach((message, i) => {
      assert.equal(message.time, theirs[i].stamp);
      if (message.value.header) near(message.value.header.stamp.sec * 1e6 + message.value.header.stamp.nanosec / 1e3, theirs[i].stamp, 0.01);
      check(message.value, theirs[i].words);
    });
  };
  compare("/scan", "LMS200/LRF/180DegreeScan", (scan, words) => {
    assert.equal(scan.ranges.length, 180);
    near(scan.angle_min, -Math.PI / 2, 1e-6);
    near(scan.angle_max, Math.PI / 2, 1e-6);
    words.forEach((word, i) => {
      if (word === 0) assert.ok(Number.isNaN(scan.ranges[i]));
      else if (word >= 8000) assert.equal(scan.ranges[i], Infinity);
      else near(scan.ranges[i], word / 1000, 1e-6);
    });
  });
  compare("/odom", "odometry/odometry/pose", (odom, words) => {
    near(odom.pose.pose.position.x, length(words[0]));
    near(odom.pose.pose.position.y, length(words[1]));
    near(Math.sin(heading(odom.pose.pose.orientation) - angle(words[2])), 0);
    near(odom.twist.twist.linear.x, length(words[3]));
  });
  compare("/ground_truth", "reference/groundTruth/pose", (pose, words) => near(pose.pose.position.x, length(words[0])));
  compare("/ortung/omnivision/camera/post1Distance", "omnivision/camera/post1Distance", (message, words) => assert.deepEqual([...message.data], words));

  // map -> odom -> base_link is the truth.
  const truth = new Map(of("/ground_truth").map((message) => [message.time, message.value.pose]));
  let chains = 0;
  for (const { time, value } of of("/tf")) {
    const frame = (child) => value.transforms.find((one) => one.child_frame_id === child)?.transform;
    const [inMap, inOdom] = [frame("odom"), frame("base_link")];
    if (!inMap || !inOdom || !truth.has(time)) continue;
    const theta = heading(inMap.rotation);
    const { x, y } = inOdom.translation;
    near(inMap.translation.x + Math.cos(theta) * x - Math.sin(theta) * y, truth.get(time).position.x);
    near(inMap.translation.y + Math.sin(theta) * x + Math.cos(theta) * y, truth.get(time).position.y);
    chains++;
  }
  assert.ok(chains > 40);
  const mount = of("/tf_static")[0].value.transforms.find((one) => one.child_frame_id === of("/scan")[0].value.header.frame_id);
  near(mount.transform.translation.x, 0.1);
  const map = of("/map")[0].value;
  assert.equal(map.data.length, map.info.width * map.info.height);
  assert.ok(map.data.includes(100) && map.data.includes(0));
});

test("the definitions are those of ROS 2's packages", async (t) => {
  const at = folder(t);
  ortung("sim", `${source}/maps/fields/f2000.toml`, "--robot", `${source}/maps/robots/sonar_ring.toml`, "--duration", "1", "--free-run", "--record", at("run.txt"));
  ortung("export", "mcap", `record:${at("run.txt")}`, "--robot", `${source}/maps/robots/sonar_ring.toml`, "--world", `${source}/maps/fields/f2000.toml`, "--out", at("run.mcap"));
  const { reader } = await readIndexed(at("run.mcap"));
  for (const schema of reader.schemasById.values()) {
    const type = schema.name.replace("/msg/", "/");
    const ours = fieldsOf(parseSchema(new TextDecoder().decode(schema.data)), type);
    const theirs = fieldsOf(definitions(type), type);
    if (type === "sensor_msgs/Range") theirs[type] = theirs[type].filter(([, name]) => name !== "variance"); // of later versions
    // Time is a type of its own for one of the two parsers.
    delete ours["builtin_interfaces/Time"];
    assert.deepEqual(ours, theirs, schema.name);
  }
  assert.ok(reader.schemasById.size >= 5);
});

/** A bag of others with two scanners, one behind and turned round. */
async function foreignBag(options) {
  const pieces = [];
  let size = 0;
  const writable = {
    position: () => BigInt(size),
    write: async (bytes) => {
      pieces.push(Buffer.from(bytes));
      size += bytes.length;
    },
  };
  const writer = new McapWriter({ writable, chunkSize: 2000, ...options });
  await writer.start({ profile: "ros2", library: "somebody's" });
  const channels = new Map();
  const add = async (topic, type, message, logTime) => {
    if (!channels.has(topic)) {
      const name = type.replace("/", "/msg/");
      // Readers of bags go by the name of a type.
      const schemaId = await writer.registerSchema({ name, encoding: "ros2msg", data: new TextEncoder().encode("") });
      const id = await writer.registerChannel({ topic, schemaId, messageEncoding: "cdr", metadata: new Map() });
      channels.set(topic, { id, writer: new MessageWriter(definitions(type)) });
    }
    const channel = channels.get(topic);
    await writer.addMessage({ channelId: channel.id, sequence: 0, logTime, publishTime: logTime, data: channel.writer.writeMessage(message) });
  };
  const zero = { x: 0, y: 0, z: 0 };
  const none = { x: 0, y: 0, z: 0, w: 1 };
  const frame = (parent, child, translation, rotation, stamp) => ({ transforms: [{ header: { stamp, frame_id: parent }, child_frame_id: child, transform: { translation, rotation } }] });
  const start = { sec: 100, nanosec: 0 };
  await add("/tf_static", "tf2_msgs/TFMessage", frame("base_link", "front", { x: 0.2, y: 0, z: 0.1 }, none, start), 100_000_000_000n);
  for (let i = 0; i < 50; i++) {
    const stamp = { sec: 100 + Math.floor(i / 10), nanosec: (i % 10) * 100_000_000 };
    const time = BigInt(stamp.sec) * 1_000_000_000n + BigInt(stamp.nanosec);
    const scan = (frame_id) => ({
      header: { stamp, frame_id }, angle_min: -1, angle_max: 1, angle_increment: 0.5, time_increment: 0, scan_time: 0.1, range_min: 0.1, range_max: 12,
      ranges: Float32Array.from([1 + i / 100, NaN, Infinity, 20, 0]), intensities: Float32Array.from([1, 2, 3, 4, 5]),
    });
    await add("/front/scan", "sensor_msgs/LaserScan", scan("front"), time);
    await add("/rear/scan", "sensor_msgs/LaserScan", scan("rear"), time);
    await add("/odom", "nav_msgs/Odometry", {
      header: { stamp, frame_id: "odom" }, child_frame_id: "base_link",
      pose: { pose: { position: { x: i / 10, y: -1, z: 0 }, orientation: { x: 0, y: 0, z: Math.SQRT1_2, w: Math.SQRT1_2 } }, covariance: new Float64Array(36) },
      twist: { twist: { linear: { x: 1, y: 0, z: 0 }, angular: zero }, covariance: new Float64Array(36) },
    }, time);
  }
  await add("/tf_static", "tf2_msgs/TFMessage", frame("base_link", "rear", { x: -0.3, y: 0, z: 0.1 }, { x: 0, y: 0, z: 1, w: 0 }, start), 105_000_000_000n);
  await add("/map", "nav_msgs/OccupancyGrid", {
    header: { stamp: start, frame_id: "map" }, info: { map_load_time: start, resolution: 0.5, width: 4, height: 3, origin: { position: { x: -1, y: 0, z: 0 }, orientation: none } },
    data: Int8Array.from([100, 100, 100, 100, 100, 0, 0, 100, 100, 100, 100, 100]),
  }, 105_000_000_000n);
  if (options.end !== false) await writer.end();
  return Buffer.concat(pieces);
}

const kinds = {
  "in chunks": {},
  "in chunks of zstd": { compressChunk: (bytes) => ({ compression: "zstd", compressedData: zstd.compress(bytes, 3) }) },
  "without chunks": { useChunks: false },
  "without a summary": { useSummaryOffsets: false, useStatistics: false, repeatSchemas: false, repeatChannels: false, useChunkIndex: false, useMessageIndex: false },
};
for (const [name, options] of Object.entries(kinds)) {
  test(`a bag that @mcap/core wrote ${name} is imported`, async (t) => {
    const at = folder(t);
    writeFileSync(at("bag.mcap"), await foreignBag(options));
    ortung("import", "mcap", at("bag.mcap"), "--out", at("bag.txt"), "--robot-file", at("robot.toml"), "--world", at("world.toml"));
    const readings = record(at("bag.txt"));
    const front = readings.filter((reading) => reading.id === "front_scan/LRF/scan");
    assert.equal(front.length, 50);
    assert.equal(front[7].stamp, 100_700_000);
    assert.deepEqual(front[7].words, [1070, 0, 12001, 12001, 0]);
    assert.equal(readings.filter((reading) => reading.id === "rear_scan/LRF/scan").length, 50);
    const odometry = readings.filter((reading) => reading.id === "odometry/odometry/pose");
    assert.deepEqual(odometry[20].words, [2 ** 31 + 2000, 2 ** 31 - 1000, 27000, 2 ** 31 + 1000, 2 ** 31]);
    const robot = readFileSync(at("robot.toml"), "utf8");
    assert.match(robot, /x_m = 0\.2, y_m = 0\.0, theta_deg = 0\.0/);
    assert.match(robot, /x_m = -0\.3, y_m = 0\.0, theta_deg = 180\.0/);
    assert.match(readFileSync(at("world.yaml"), "utf8"), /resolution: 0\.5\norigin: \[-1\.0, 0\.0, 0\]/);
  });
}

test("a bag whose writer was killed is imported up to its end", async (t) => {
  const at = folder(t);
  const whole = await foreignBag({ end: false });
  writeFileSync(at("bag.mcap"), whole.subarray(0, Math.floor(whole.length * 0.6)));
  ortung("import", "mcap", at("bag.mcap"), "--out", at("bag.txt"));
  const count = record(at("bag.txt")).filter((reading) => reading.id.endsWith("/LRF/scan")).length;
  assert.ok(count > 20 && count < 100, `${count}`);
});
