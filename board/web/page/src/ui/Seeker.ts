import type { Session } from "../model/Session";
import { plain } from "../link/words";

/** Goes to times of a record: of many that are wanted while one is gone to, to the last one. */
export class Seeker {
  private wanted: number | null = null;
  private isSending = false;

  constructor(private readonly session: Session) {}

  get canSeek(): boolean {
    const { board } = this.session;
    return board.isOperator && board.can("SEEK");
  }

  /** @param seconds since the record's beginning */
  async goTo(seconds: number): Promise<void> {
    this.wanted = Math.max(0, seconds);
    if (this.isSending) return;
    this.isSending = true;
    while (this.wanted !== null) {
      const next = this.wanted;
      this.wanted = null;
      await this.session.act(`SEEK time_s=${plain(next)}`, "time");
    }
    this.isSending = false;
  }
}
