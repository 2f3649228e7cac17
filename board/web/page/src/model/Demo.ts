import type { Insight } from "./Insight";
import type { Session } from "./Session";

/** Time of the world up to which the demo runs slowly, an update a second: then the cloud has fallen together [us]. */
const kSlowUntil = 700_000;
const kSlow = 0.1;

/** Begins the demo anew when its page is open: what is seen first is that nothing is known. */
export class Demo {
  private step: "waits" | "begins" | "slow" | "over" = "waits";

  constructor(
    private readonly session: Session,
    private readonly insight: Insight,
  ) {}

  /** To be called when anything has changed. */
  look(): void {
    const { board } = this.session;
    const isReady = board.isOperator && board.can("LOCALIZE") && /^(searching|running)$/.test(this.insight.localize?.state ?? "");
    if (this.step === "waits" && isReady) {
      this.step = "begins";
      void this.begin();
    } else if (this.step === "slow" && board.state === "running" && board.now > kSlowUntil) {
      this.step = "over";
      void this.session.act("SPEED 1", "time");
    }
  }

  private async begin(): Promise<void> {
    await this.session.act(`SPEED ${kSlow}`, "time");
    await this.session.act("RESET", "time");
    this.step = "slow";
  }
}
