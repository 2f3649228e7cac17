import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { BoardError, Connection, type Line } from "../src/link/Connection";

const kOpen = 1;

/** A socket that remembers what it was given, and says what it is told. */
function fakeLine() {
  const sent: string[] = [];
  const line: { -readonly [K in keyof Line]: Line[K] } = {
    readyState: kOpen,
    binaryType: "blob",
    onopen: null,
    onmessage: null,
    onclose: null,
    send: (data) => void sent.push(new TextDecoder().decode(data as Uint8Array)),
    close: () => line.onclose?.call(line as unknown as WebSocket, { reason: "" } as CloseEvent),
  };
  const says = (text: string) => line.onmessage!.call(line as unknown as WebSocket, { data: text } as MessageEvent);
  return { line, sent, says };
}

function opened() {
  const fake = fakeLine();
  const closed: [string, number][] = [];
  const connection = new Connection(() => fake.line, {
    opened: () => undefined,
    closed: (why, againIn) => closed.push([why, againIn]),
    unasked: () => undefined,
  });
  connection.open();
  return { ...fake, connection, closed };
}

const codeOf = (request: Promise<unknown>) =>
  request.then(
    () => "answered",
    (error: BoardError) => error.code,
  );

describe("a connection to the board", () => {
  beforeEach(() => {
    vi.stubGlobal("WebSocket", { OPEN: kOpen });
    vi.useFakeTimers();
  });
  afterEach(() => {
    vi.useRealTimers();
    vi.unstubAllGlobals();
  });

  it("answers requests in their order", async () => {
    const { connection, sent, says } = opened();
    const both = [connection.request("TIME"), connection.request("STATUS")];
    expect(sent).toEqual(["#v1 TIME\n", "#v2 STATUS\n"]);
    says("#v1 OK TIME sent=7\n#v2 ERR limit too many\n");
    expect((await both[0]!).keys.get("sent")).toBe("7");
    await expect(both[1]).rejects.toMatchObject({ code: "limit", message: "too many", request: "STATUS" });
  });

  it("sends nothing but plain ASCII, so that no line holds another one", async () => {
    const { connection, sent } = opened();
    for (const line of ["SAY h\u00e4", "SAY a\nBYE", "SAY a\rb", "SAY \u007f"]) {
      expect(await codeOf(connection.request(line))).toBe("syntax");
    }
    expect(sent).toEqual([]);
  });

  it("leaves no request without an answer when it is lost", async () => {
    const { connection, line, closed } = opened();
    const request = codeOf(connection.request("TIME"));
    line.close();
    expect(await request).toBe("closed");
    expect(await codeOf(connection.request("TIME"))).toBe("closed");
    expect(closed).toEqual([["the server can't be reached", 0.5]]);
  });

  it("waits longer from try to try, and not after a good greeting", () => {
    const { connection, line, closed } = opened();
    for (let i = 0; i < 8; ++i) {
      line.close();
      vi.advanceTimersByTime(5000);
    }
    const waits = closed.map(([, againIn]) => againIn);
    expect(waits.slice(0, 3).map((wait) => wait.toFixed(2))).toEqual(["0.50", "0.80", "1.28"]);
    expect(waits.at(-1)).toBe(5);
    connection.settled();
    line.close();
    expect(closed.at(-1)![1]).toBe(0.5);
  });

  it("says why it was lost, in its own words before the server's", () => {
    const { connection, line, closed } = opened();
    line.onclose!.call(line as unknown as WebSocket, { reason: "full" } as CloseEvent);
    connection.open();
    connection.fail("what it says is odd");
    connection.open();
    connection.close("a new connection");
    expect(closed.map(([why]) => why)).toEqual(["full", "what it says is odd", "a new connection"]);
  });

  it("ends where an answer comes that nobody has asked for", () => {
    const { says, closed } = opened();
    says("#v9 OK TIME\n");
    expect(closed[0]![0]).toContain("without a request");
  });
});
