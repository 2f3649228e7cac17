import { StreamParser, type Message } from "./StreamParser";
import { parseHead } from "./words";

/** An answer of the message board. */
export interface Reply {
  command: string;
  words: string[];
  keys: Map<string, string>;
  lines: string[];
  bytes: Uint8Array | null;
}

/** `ERR CODE text`, or the end of the connection (code `closed`). */
export class BoardError extends Error {
  constructor(
    readonly code: string,
    message: string,
    readonly request: string,
  ) {
    super(message);
  }
}

export interface Unasked {
  word: string;
  keys: Map<string, string>;
  text: string;
  message: Message;
}

interface Waiting {
  tag: string;
  line: string;
  resolve: (reply: Reply) => void;
  reject: (error: BoardError) => void;
}

/** What is used of a WebSocket. */
export type Line = Pick<
  WebSocket,
  "readyState" | "binaryType" | "onopen" | "onmessage" | "onclose" | "send" | "close"
>;

export interface ConnectionEvents {
  /** A socket is open; nothing has been said yet. */
  opened(): void;
  /** The connection is gone; another try follows after so many seconds. */
  closed(why: string, againIn: number): void;
  unasked(unasked: Unasked): void;
}

const kShortestWait = 0.5;
const kLongestWait = 5;

/** A connection to the message board that comes back by itself. Requests are answered in order. */
export class Connection {
  private socket: Line | null = null;
  private waiting: Waiting[] = [];
  private tag = 0;
  private wait = kShortestWait;
  private why = "";
  private timer: ReturnType<typeof setTimeout> | undefined;
  private readonly encoder = new TextEncoder();
  bytesRead = 0;

  constructor(
    private readonly dial: () => Line,
    private readonly events: ConnectionEvents,
  ) {}

  open(): void {
    clearTimeout(this.timer);
    this.why = "";
    const socket = this.dial();
    const parser = new StreamParser((message) => this.take(message));
    socket.binaryType = "arraybuffer";
    this.socket = socket;
    socket.onopen = () => this.events.opened();
    socket.onmessage = (event: MessageEvent) => {
      if (socket !== this.socket) return;
      const piece =
        typeof event.data === "string" ? this.encoder.encode(event.data) : new Uint8Array(event.data as ArrayBuffer);
      this.bytesRead += piece.length;
      try {
        parser.push(piece);
      } catch (error) {
        this.why = `what the server says can't be understood: ${(error as Error).message}`;
        socket.close();
      }
    };
    socket.onclose = (event) => {
      if (socket === this.socket) this.lost(event.reason);
    };
  }

  /** Says that the greeting was good, so the next loss is followed by a quick try. */
  settled(): void {
    this.wait = kShortestWait;
  }

  get isOpen(): boolean {
    return this.socket?.readyState === WebSocket.OPEN;
  }

  /** Why the connection should not be used any more; it is closed, and tried again. */
  fail(why: string): void {
    this.why = why;
    this.socket?.close();
  }

  /** Ends this connection, if there is one, and begins the next one at once. */
  comeAgain(): void {
    this.close("a new connection");
    this.open();
  }

  /** Ends this connection for good, until `open`. */
  close(why: string): void {
    const { socket } = this;
    this.socket = null;
    socket?.close();
    this.lost(why);
    clearTimeout(this.timer);
    this.wait = kShortestWait;
  }

  request(line: string): Promise<Reply> {
    return new Promise((resolve, reject) => {
      if (!this.isOpen) return reject(new BoardError("closed", "there is no connection", line));
      if (/[^\x20-\x7e]/.test(line)) {
        return reject(new BoardError("syntax", "only plain ASCII can be sent", line));
      }
      const tag = `v${++this.tag}`;
      this.waiting.push({ tag, line, resolve, reject });
      this.socket!.send(this.encoder.encode(`#${tag} ${line}\n`));
    });
  }

  private lost(reason: string): void {
    this.socket = null;
    const why = this.why || reason || "the server can't be reached";
    const waiting = this.waiting;
    this.waiting = [];
    for (const { line, reject } of waiting) reject(new BoardError("closed", "the connection was lost", line));
    this.events.closed(why, this.wait);
    this.timer = setTimeout(() => this.open(), this.wait * 1000);
    this.wait = Math.min(this.wait * 1.6, kLongestWait);
  }

  private take(message: Message): void {
    const { line } = message;
    if (line.startsWith("* ")) return this.takeUnasked(message);
    const match = /^#(\S+) (OK|ERR) (.*)$/.exec(line);
    if (!match) {
      this.why = line.slice(0, 200);
      return;
    }
    const first = this.waiting.shift();
    if (!first || first.tag !== match[1]) {
      this.fail(`an answer came without a request: ${line.slice(0, 80)}`);
      return;
    }
    if (match[2] === "ERR") {
      const [code = "", ...rest] = match[3]!.split(" ");
      first.reject(new BoardError(code, rest.join(" "), first.line));
      return;
    }
    const { words, keys } = parseHead(match[3]!);
    const [command = "", ...others] = words;
    first.resolve({ command, words: others, keys, lines: message.lines, bytes: message.bytes });
  }

  private takeUnasked(message: Message): void {
    const [word = "", ...rest] = message.line.slice(2).split(" ");
    const text = rest.join(" ");
    if (word === "BYE" || word === "ERR") this.why = text;
    this.events.unasked({ word, keys: parseHead(text).keys, text, message });
  }
}
