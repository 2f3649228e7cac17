import { mostBytes, sendFile, type Sending } from "../link/openFile";
import type { Board } from "./Board";

/** How far the opening of a file is. */
export type OpeningState =
  | { phase: "none" }
  | { phase: "sending"; name: string; share: number }
  | { phase: "reading"; name: string }
  | { phase: "failed"; text: string };

/** What is used of the page around it. */
export interface OpeningHost {
  board: Board;
  /** Where files are sent to; null where no program is behind the page. */
  url: string | null;
  token(): string;
}

const inMega = (bytes: number) => `${(bytes / 1e6).toFixed(bytes < 1e7 ? 1 : 0)} MB`;

/** Opens files of the user: the program behind the page reads them, and shows them then. One at a time. */
export class FileOpening {
  state: OpeningState = { phase: "none" };
  private sending: Sending | null = null;

  constructor(private readonly host: OpeningHost) {}

  /** Whether there is a program that opens files, as far as is known without asking it. */
  get isPossible(): boolean {
    return this.host.url !== null && this.host.board.kind === "record";
  }

  get isBusy(): boolean {
    return this.state.phase === "sending" || this.state.phase === "reading";
  }

  /** @param isBeside whether it is shown beside what is shown, not instead of it */
  async open(files: readonly File[], isBeside: boolean): Promise<void> {
    const [file] = files;
    if (!file || this.isBusy) return;
    const { board, url } = this.host;
    if (files.length > 1) return this.fail(`${files.length} files were given: open one after another`);
    if (url === null) return this.fail(`This page has no program behind it that could read ${file.name}: open it by "ortung view ${file.name}"`);
    this.set({ phase: "sending", name: file.name, share: 0 });
    const most = await mostBytes(url);
    if (most === null) return this.fail(`The program behind this page opens no files: open it by "ortung view ${file.name}"`);
    if (!board.isOperator) return this.fail("Only operators open files: this page's address has no valid token");
    if (file.size > most) return this.fail(`${file.name} has ${inMega(file.size)}, more than ${inMega(most)} (--drop-limit)`);
    this.sending = sendFile(url, file, this.host.token(), isBeside, (share) =>
      this.set(share < 1 ? { phase: "sending", name: file.name, share } : { phase: "reading", name: file.name }));
    const { isOpened, text } = await this.sending.done;
    this.sending = null;
    if (isOpened || text === "cancelled") this.set({ phase: "none" });
    else this.fail(text);
  }

  cancel(): void {
    this.sending?.cancel();
  }

  forget(): void {
    if (this.state.phase === "failed") this.set({ phase: "none" });
  }

  fail(text: string): void {
    this.set({ phase: "failed", text });
  }

  private set(state: OpeningState): void {
    this.state = state;
    this.host.board.touch();
  }
}
