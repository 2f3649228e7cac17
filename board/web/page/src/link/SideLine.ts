import { BoardError, Connection, type Line, type Reply } from "./Connection";

/**
 * A connection beside the first one, for what takes the server long: answers come in the order of requests, so nothing
 * else waits behind it. It only looks, is there while somebody asks, and comes in as the first one did.
 */
export class SideLine {
  private readonly connection: Connection;
  private isOpening = false;
  private greeted: Promise<void> = Promise.resolve();
  private settle: { resolve: () => void; reject: (error: BoardError) => void } | null = null;

  /** @param hello what is said first, newest at each opening */
  constructor(
    dial: () => Line,
    private readonly hello: () => string,
  ) {
    this.connection = new Connection(dial, {
      opened: () => void this.greet(),
      closed: (why) => this.closed(why),
      unasked: () => {},
    });
  }

  /** @throws BoardError what the server answers, or `closed` if there is no connection */
  async ask(line: string): Promise<Reply> {
    if (!this.isOpening) this.begin();
    await this.greeted;
    return this.connection.request(line);
  }

  /** Nothing more is asked, or another server answers from now on. */
  close(): void {
    if (this.isOpening) this.connection.close("it is not needed");
    this.isOpening = false;
  }

  private begin(): void {
    this.isOpening = true;
    this.wait();
    this.connection.open();
  }

  private wait(): void {
    this.greeted = new Promise((resolve, reject) => (this.settle = { resolve, reject }));
    this.greeted.catch(() => {}); // requests report the failure; there may be none
  }

  private async greet(): Promise<void> {
    try {
      await this.connection.request(this.hello());
      this.connection.settled();
      this.settle?.resolve();
    } catch (error) {
      if (!(error instanceof BoardError)) throw error;
      this.settle?.reject(error);
      if (error.code !== "closed") this.connection.fail(error.message);
    }
  }

  /** The connection tries again by itself: who asks meanwhile waits for the next greeting. */
  private closed(why: string): void {
    this.settle?.reject(new BoardError("closed", `the connection for maps was lost: ${why}`, ""));
    this.wait();
  }
}
