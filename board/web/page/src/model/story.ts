import { placesOf } from "./decode";
import type { Robot } from "./Robot";

const kTold = 10e6;
const kLeastShare = 0.02;

/** How a robot finds its place, in a line: what is not decided yet, and when that ends. */
export class Story {
  private doubt: { begin: number; places: number } | null = null;
  private found: { at: number; text: string } | null = null;
  private last = 0;

  /** @param now time of the world [us] */
  tell(robot: Robot, now: number): string {
    if (now < this.last) this.doubt = this.found = null; // it began anew
    this.last = now;
    const { status } = robot;
    if (!status) return "";
    if (status.reason === "the field is searched") {
      this.doubt ??= { begin: now, places: 0 };
      return "It may be anywhere: the whole field is searched.";
    }
    if (status.reason === "several places fit") {
      this.found = null;
      const held = robot.heldOf("clusters");
      const shares = placesOf(held?.words ?? new Uint32Array()).map(({ share }) => share).filter((share) => share >= kLeastShare);
      this.doubt = { begin: this.doubt?.begin ?? now, places: Math.max(shares.length, this.doubt?.places ?? 0) };
      if (shares.length < 2) return "Several places fit what it senses: it can't tell them apart yet.";
      const list = shares.slice(0, 4).map((share) => `${(100 * share).toFixed(0)} %`).join(", ");
      return `${shares.length} places fit what it senses (${list}): it can't tell them apart yet.`;
    }
    if (status.status === "tracking") {
      if (this.doubt) this.found = { at: now, text: this.ending(now) };
      this.doubt = null;
      return this.found && now - this.found.at < kTold ? this.found.text : "";
    }
    return this.doubt ? `Not sure yet: ${status.reason}.` : "";
  }

  private ending(now: number): string {
    const { begin, places } = this.doubt!;
    const time = `${((now - begin) / 1e6).toFixed(1)} s`;
    return places > 1 ? `Found: of ${places} places one is left, after ${time}.` : `Found, after ${time}.`;
  }
}
