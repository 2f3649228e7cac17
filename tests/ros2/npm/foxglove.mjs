// Foxglove's WebSocket protocol against its own client.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { once } from "node:events";
import test from "node:test";
import { MessageReader } from "@foxglove/rosmsg2-serialization";
import protocols from "@foxglove/ws-protocol";
import { WebSocket } from "ws";
import { folder, ortung, parseSchema, program, source } from "./common.mjs";

const { FoxgloveClient } = protocols;

const limit = { timeout: 60_000 }; // so that a test that waits in vain is named
const sockets = new Set();

/** A connection to a server, closed before the server ends. */
function connect(url, protocol) {
  const socket = new WebSocket(url, [protocol]);
  sockets.add(socket);
  return socket;
}

/** A server on a port of its own. Its output is read to the end: a server whose reader went away would end, too. */
async function serve(t, ...words) {
  const server = spawn(program, words, { stdio: ["ignore", "pipe", "pipe"] });
  const ended = once(server, "close");
  t.after(async () => {
    for (const socket of sockets) socket.terminate();
    sockets.clear();
    server.kill("SIGTERM");
    await ended;
  });
  let text = "";
  server.stderr.on("data", (piece) => (text += piece));
  const hasPage = words.includes("--view") || words[0] === "view";
  return new Promise((resolve, reject) => {
    server.on("error", reject);
    server.on("close", (code, signal) => reject(new Error(`the server ended with ${code ?? signal}: ${text}`)));
    server.stdout.on("data", (piece) => {
      text += piece;
      const port = /port (\d+)\n/.exec(text);
      const token = /#token=(\w+)\n/.exec(text);
      if (port && (token || !hasPage)) resolve({ port: port[1], token: token?.[1] });
    });
  });
}

/** Subscribes to topics until each has told `count` messages. */
function hear(url, protocol, wanted, count) {
  return new Promise((resolve, reject) => {
    const socket = connect(url, protocol);
    const client = new FoxgloveClient({ ws: socket });
    const heard = new Map(wanted.map((topic) => [topic, []]));
    const subscriptions = new Map();
    const told = { info: null, channels: [], statuses: [], times: 0, heard, socket };
    client.on("error", reject);
    socket.on("error", reject);
    socket.on("close", (code) => reject(new Error(`the server left with ${code}`)));
    client.on("serverInfo", (info) => (told.info = info));
    client.on("status", (status) => told.statuses.push(status));
    client.on("time", () => told.times++);
    client.on("advertise", (channels) => {
      told.channels.push(...channels);
      for (const channel of channels)
        if (heard.has(channel.topic))
          subscriptions.set(client.subscribe(channel.id), { topic: channel.topic, reader: new MessageReader(parseSchema(channel.schema)) });
    });
    const take = ({ subscriptionId, timestamp, data }) => {
      const { topic, reader } = subscriptions.get(subscriptionId);
      heard.get(topic).push({ time: timestamp, value: reader.readMessage(data) });
      if (![...heard].every(([name, list]) => list.length >= (name === "/tf_static" || name === "/map" ? 1 : count))) return;
      client.off("message", take);
      resolve(told);
      client.close();
    };
    client.on("message", take);
  });
}

for (const protocol of ["foxglove.websocket.v1", "foxglove.sdk.v1"]) {
  test(`${protocol}: a simulated robot is told in messages that its client can read`, limit, async (t) => {
    const { port } = await serve(t, "sim", `${source}/maps/fields/f2000.toml`, "--robot", `${source}/maps/robots/pioneer_lrf.toml`, "--view", "--listen", "0", "--speed", "20");
    const topics = ["/tf", "/tf_static", "/pioneer_lrf/scan", "/pioneer_lrf/odom"];
    const { info, channels, heard, statuses, times } = await hear(`ws://127.0.0.1:${port}/`, protocol, topics, 20);
    assert.match(info.name, /f2000/);
    assert.ok(info.capabilities.includes("time") && times > 0);
    assert.deepEqual(statuses, []);
    assert.ok(channels.every((channel) => channel.encoding === "cdr" && channel.schemaEncoding === "ros2msg"));
    const scan = heard.get("/pioneer_lrf/scan")[0].value;
    assert.equal(scan.ranges.length, 180);
    assert.ok([...scan.ranges].some((range) => range > 0.1 && range < 8));
    const frames = new Set(heard.get("/tf").flatMap(({ value }) => value.transforms.map((one) => `${one.header.frame_id}>${one.child_frame_id}`)));
    assert.ok(frames.has("pioneer_lrf/odom>pioneer_lrf/base_link"), [...frames].join());
    assert.equal(heard.get("/tf_static")[0].value.transforms.at(-1).child_frame_id, scan.header.frame_id);
    const stamps = heard.get("/pioneer_lrf/odom").map(({ time }) => time);
    assert.ok(stamps.every((time, i) => i === 0 || time > stamps[i - 1]));
  });
}

test("a server without a page speaks it, too", limit, async (t) => {
  const { port } = await serve(t, "sim", `${source}/maps/fields/f2000.toml`, "--robot", `${source}/maps/robots/pioneer_lrf.toml`, "--listen", "0", "--speed", "20");
  const { info, heard } = await hear(`ws://127.0.0.1:${port}/`, "foxglove.sdk.v1", ["/pioneer_lrf/scan"], 3);
  assert.ok(info.capabilities.includes("clientPublish") && info.supportedEncodings.includes("json"));
  assert.equal(heard.get("/pioneer_lrf/scan")[0].value.ranges.length, 180);
  const page = await fetch(`http://127.0.0.1:${port}/`);
  assert.match(await page.text(), /shows no page/);
});

test("who has the token places and drives a robot, who has not is told so", limit, async (t) => {
  const { port, token } = await serve(t, "sim", `${source}/maps/fields/f2000.toml`, "--robot", `${source}/maps/robots/pioneer_lrf.toml`, "--view", "--listen", "0", "--no-browser");
  const until = async (isDone) => {
    while (!isDone()) await new Promise((done) => setTimeout(done, 20)); // the test's own time limit ends it
  };
  const meet = async (url) => {
    const socket = connect(url, "foxglove.sdk.v1");
    const client = new FoxgloveClient({ ws: socket });
    const told = { client, statuses: [], channels: new Map(), odometry: [] };
    client.on("status", (status) => told.statuses.push(status));
    const readers = new Map();
    client.on("advertise", (channels) => {
      for (const channel of channels) {
        told.channels.set(channel.topic, channel);
        if (channel.topic !== "/pioneer_lrf/odom") continue;
        readers.set(client.subscribe(channel.id), new MessageReader(parseSchema(channel.schema)));
      }
    });
    client.on("message", ({ subscriptionId, data }) => told.odometry.push(readers.get(subscriptionId).readMessage(data)));
    await until(() => told.odometry.length > 1);
    return told;
  };
  const drive = (told, speed) => {
    const id = told.client.advertise({ topic: "/cmd_vel", encoding: "json", schemaName: "geometry_msgs/msg/Twist" });
    told.client.sendMessage(id, new TextEncoder().encode(JSON.stringify({ linear: { x: 0, y: 0, z: 0 }, angular: { x: 0, y: 0, z: speed } })));
  };
  const guest = await meet(`ws://127.0.0.1:${port}/`);
  drive(guest, 0.7);
  await until(() => guest.statuses.length > 0);
  assert.match(guest.statuses[0].message, /operator/);
  const operator = await meet(`ws://127.0.0.1:${port}/?token=${token}`);
  drive(operator, 0.7);
  const turns = () => operator.odometry.at(-1).twist.twist.angular.z;
  await until(() => Math.abs(turns() - 0.7) < 0.05);
  const id = operator.client.advertise({ topic: "/initialpose", encoding: "json", schemaName: "geometry_msgs/msg/PoseWithCovarianceStamped" });
  operator.client.sendMessage(id, new TextEncoder().encode(JSON.stringify({ header: { frame_id: "map" }, pose: { pose: { position: { x: 1, y: 1, z: 0 }, orientation: { x: 0, y: 0, z: 0, w: 1 } } } })));
  assert.deepEqual(operator.statuses, []);
});

test("nonsense is answered and does not end the conversation", limit, async (t) => {
  const { port } = await serve(t, "sim", `${source}/maps/fields/f2000.toml`, "--robot", `${source}/maps/robots/pioneer_lrf.toml`, "--view", "--listen", "0");
  const socket = connect(`ws://127.0.0.1:${port}/`, "foxglove.sdk.v1");
  const answers = [];
  const enough = new Promise((resolve, reject) => {
    socket.on("error", reject);
    socket.on("message", (data, isBinary) => {
      if (isBinary) return;
      const message = JSON.parse(data.toString());
      if (message.op === "status") answers.push(message);
      if (answers.length === 6) resolve();
    });
  });
  await once(socket, "open");
  socket.send("{");
  socket.send('["op"]');
  socket.send('{"op":"subscribe","subscriptions":[{"id":-1,"channelId":1}]}');
  socket.send('{"op":"subscribe","subscriptions":[{"id":1,"channelId":99999}]}');
  socket.send('{"op":"callService"}');
  socket.send(Buffer.from([3, 0, 0, 0, 128, 63, 0, 0, 0, 0, 0, 0, 0, 0, 0])); // play a simulation
  await enough;
  assert.ok(answers.every((answer) => answer.level >= 1 && answer.message.length > 10), JSON.stringify(answers));
  socket.close();
  await once(socket, "close");
});

test("a client with the token plays, pauses and seeks in a record", limit, async (t) => {
  const at = folder(t);
  const robot = `${source}/maps/robots/pioneer_lrf.toml`;
  ortung("sim", `${source}/maps/fields/f2000.toml`, "--robot", robot, "--duration", "20", "--free-run", "--record", at("run.rec"));
  ortung("learn", "--world", `${source}/maps/fields/f2000.toml`, "--robot", robot, "--out", at("t.ortung"));
  const { port, token } = await serve(t, "view", at("run.rec"), "--robot", robot, "--tables", at("t.ortung"), "--listen", "0", "--no-browser");
  const socket = connect(`ws://127.0.0.1:${port}/?token=${token}`, "foxglove.sdk.v1");
  // Several answers may come at once, so all are kept until somebody asks for one.
  const answers = [];
  const nextAnswer = async (isWanted) => {
    while (!answers.some(isWanted)) await once(socket, "message");
    return answers.splice(answers.findIndex(isWanted), 1)[0];
  };
  const channels = new Map();
  let info = null;
  const scans = [];
  socket.on("message", (data, isBinary) => {
    if (isBinary && data[0] === 5) {
      answers.push({ status: data[1], time: Number(data.readBigUInt64LE(2)) / 1e9, speed: data.readFloatLE(10), sought: data[14], id: data.subarray(19).toString() });
    } else if (isBinary && data[0] === 1) {
      scans.push(Number(data.readBigUInt64LE(5)) / 1e9);
    } else if (!isBinary) {
      const message = JSON.parse(data.toString());
      if (message.op === "serverInfo") info = message;
      if (message.op === "status") answers.push(message);
      for (const channel of message.channels ?? []) {
        channels.set(channel.topic, channel);
        if (channel.topic === "/scan") socket.send(JSON.stringify({ op: "subscribe", subscriptions: [{ id: 1, channelId: channel.id }] }));
      }
    }
  });
  await once(socket, "open");
  while (!channels.has("/scan")) await once(socket, "message");
  assert.ok(info.capabilities.includes("playbackControl"), JSON.stringify(info));
  assert.ok(Math.abs(info.dataEndTime.sec + info.dataEndTime.nsec / 1e9 - 20) < 0.1, JSON.stringify(info));

  const control = (isPlay, speed, seek, id) => {
    const request = Buffer.alloc(19 + id.length);
    request[0] = 3;
    request[1] = isPlay ? 0 : 1;
    request.writeFloatLE(speed, 2);
    request[6] = seek === undefined ? 0 : 1;
    request.writeBigUInt64LE(BigInt(Math.round((seek ?? 0) * 1e9)), 7);
    request.writeUInt32LE(id.length, 15);
    request.write(id, 19);
    socket.send(request);
    return nextAnswer((answer) => answer.op === "status" || answer.id === id);
  };
  const paused = await control(false, 1, 5, "a");
  assert.deepEqual([paused.status, paused.sought, paused.id], [1, 1, "a"], JSON.stringify(paused));
  assert.ok(Math.abs(paused.time - 5) < 0.1, JSON.stringify(paused));
  scans.length = 0;
  const playing = await control(true, 50, 15, "b");
  assert.deepEqual([playing.status, playing.speed, playing.id], [0, 50, "b"], JSON.stringify(playing));
  await nextAnswer((answer) => answer.id === "" && answer.status === 3);
  assert.ok(scans.some((time) => time > 15) && scans.every((time) => time < 20.1), scans.join());
});
