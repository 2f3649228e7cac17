import { beforeAll, describe, expect, it } from "vitest";
import type { Line } from "../src/link/Connection";
import { SideLine } from "../src/link/SideLine";

beforeAll(() => {
  globalThis.WebSocket ??= { OPEN: 1 } as unknown as typeof WebSocket;
});

/** A socket whose other end is the test. */
class FakeSocket {
  readyState: number = 1;
  binaryType: BinaryType = "arraybuffer";
  onopen: ((event: Event) => void) | null = null;
  onmessage: ((event: MessageEvent) => void) | null = null;
  onclose: ((event: CloseEvent) => void) | null = null;
  readonly heard: string[] = [];
  send(bytes: unknown): void {
    this.heard.push(new TextDecoder().decode(bytes as Uint8Array).trim());
  }
  close(): void {
    this.readyState = 3;
  }
  say(text: string): void {
    this.onmessage?.({ data: `${text}\n` } as MessageEvent);
  }
  drop(): void {
    this.readyState = 3;
    this.onclose?.({ reason: "" } as CloseEvent);
  }
}

const soon = () => new Promise((resolve) => setTimeout(resolve, 0));

function start() {
  const sockets: FakeSocket[] = [];
  const side = new SideLine(
    () => {
      sockets.push(new FakeSocket());
      return sockets.at(-1) as unknown as Line;
    },
    () => "HELLO ortung/1 name=view role=viewer token=secret",
  );
  return { side, sockets };
}

describe("a connection beside the first one", () => {
  it("begins with the first question, says hello, and then asks", async () => {
    const { side, sockets } = start();
    expect(sockets).toHaveLength(0);
    const answer = side.ask("HEATMAP robot=1");
    const [socket] = sockets;
    socket!.onopen?.({} as Event);
    expect(socket!.heard).toEqual(["#v1 HELLO ortung/1 name=view role=viewer token=secret"]);
    socket!.say("#v1 OK HELLO role=viewer");
    await soon();
    expect(socket!.heard[1]).toBe("#v2 HEATMAP robot=1");
    socket!.say("#v2 OK HEATMAP columns=3");
    expect((await answer).keys.get("columns")).toBe("3");
    expect(sockets).toHaveLength(1);
  });

  it("tells who asks that it was refused, in the words of the server", async () => {
    const { side, sockets } = start();
    const answer = side.ask("HEATMAP robot=1");
    sockets[0]!.onopen?.({} as Event);
    sockets[0]!.say("#v1 ERR token this is not the token of view");
    await expect(answer).rejects.toMatchObject({ code: "token", message: "this is not the token of view" });
    side.close();
  });

  it("tells who asks that it was lost, and begins anew after it was closed", async () => {
    const { side, sockets } = start();
    const answer = side.ask("HEATMAP robot=1");
    sockets[0]!.drop();
    await expect(answer).rejects.toMatchObject({ code: "closed" });
    side.close();
    side.ask("HEATMAP robot=1").catch(() => {});
    expect(sockets).toHaveLength(2);
    side.close();
    await soon();
    expect(sockets).toHaveLength(2);
  });
});
