/**
 * What the message board says, as a stream of bytes that may be cut anywhere: lines, after a line
 * with `lines=N` N more of them, after one with `bytes=N` N raw bytes.
 */
export interface Message {
  /** The line itself, without its end. */
  line: string;
  /** The lines that belong to it, if it says `lines=`. */
  lines: string[];
  /** The bytes that belong to it, if it says `bytes=`. */
  bytes: Uint8Array | null;
}

const kMostLine = 4 * 1024 * 1024;
const kMostLines = 1_000_000;
const kMostBytes = 160 * 1024 * 1024;
const kCount = / (lines|bytes)=(\d{1,9})(?= |$)/;
const kFeed = 10;

const text = new TextDecoder("utf-8", { fatal: false });

/**
 * What is no printable character, or turns the direction of the text around it: the board has none of them, but what it
 * passes on may. Each becomes the character for what can't be shown.
 */
const kNotShown = /[\u0000-\u0008\u000a-\u001f\u007f-\u009f\u061c\u200b-\u200f\u2028-\u202e\u2060-\u206f\ufeff]/g;

export class StreamParser {
  private buffer = new Uint8Array(64 * 1024);
  private begin = 0;
  private end = 0;
  private searched = 0;
  private head: string | null = null;
  private lines: string[] = [];
  private linesToCome = 0;
  private bytesToCome = -1;

  constructor(private readonly take: (message: Message) => void) {}

  /** @throws Error if the stream can't be a message board's */
  push(piece: Uint8Array): void {
    this.append(piece);
    while (this.step()) continue;
    if (this.begin === this.end) this.begin = this.end = this.searched = 0;
  }

  private append(piece: Uint8Array): void {
    if (this.end + piece.length > this.buffer.length) {
      const held = this.end - this.begin;
      let size = this.buffer.length;
      while (size < held + piece.length) size *= 2;
      const target = size === this.buffer.length ? this.buffer : new Uint8Array(size);
      if (target === this.buffer) target.copyWithin(0, this.begin, this.end);
      else target.set(this.buffer.subarray(this.begin, this.end));
      this.buffer = target;
      this.searched -= this.begin;
      this.begin = 0;
      this.end = held;
    }
    this.buffer.set(piece, this.end);
    this.end += piece.length;
  }

  private step(): boolean {
    if (this.bytesToCome >= 0) return this.takeBytes();
    const line = this.nextLine();
    if (line === null) return false;
    if (this.head === null) this.open(line);
    else this.addLine(line);
    return true;
  }

  private nextLine(): string | null {
    const at = this.buffer.subarray(0, this.end).indexOf(kFeed, Math.max(this.begin, this.searched));
    if (at < 0) {
      this.searched = this.end;
      if (this.end - this.begin > kMostLine) throw new Error("a line is longer than 4 MiB");
      return null;
    }
    const stop = at > this.begin && this.buffer[at - 1] === 13 ? at - 1 : at;
    const line = text.decode(this.buffer.subarray(this.begin, stop)).replace(kNotShown, "\ufffd");
    this.begin = this.searched = at + 1;
    return line;
  }

  private open(line: string): void {
    if (line === "") return;
    const count = kCount.exec(line);
    const isError = /^(#\S+ )?(\* )?ERR /.test(line);
    const isSaid = line.startsWith("* SAY ");
    if (!count || isError || isSaid) return this.take({ line, lines: [], bytes: null });
    const number = Number(count[2]);
    if (count[1] === "lines") {
      if (number > kMostLines) throw new Error(`a reply announces ${number} lines`);
      if (number === 0) return this.take({ line, lines: [], bytes: null });
      this.linesToCome = number;
    } else {
      if (number > kMostBytes) throw new Error(`a reply announces ${number} bytes`);
      this.bytesToCome = number;
    }
    this.head = line;
  }

  private addLine(line: string): void {
    this.lines.push(line);
    if (this.lines.length < this.linesToCome) return;
    const message = { line: this.head!, lines: this.lines, bytes: null };
    this.head = null;
    this.lines = [];
    this.take(message);
  }

  private takeBytes(): boolean {
    if (this.end - this.begin < this.bytesToCome) return false;
    const bytes = this.buffer.slice(this.begin, this.begin + this.bytesToCome);
    this.begin = this.searched = this.begin + this.bytesToCome;
    this.bytesToCome = -1;
    const line = this.head!;
    this.head = null;
    this.take({ line, lines: [], bytes });
    return true;
  }
}
