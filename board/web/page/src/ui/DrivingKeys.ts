import { isTypedInto } from "./typing";

const kWays: Record<string, [number, number]> = {
  w: [1, 0], s: [-1, 0], a: [0, 1], d: [0, -1], ArrowUp: [1, 0], ArrowDown: [-1, 0], ArrowLeft: [0, 1], ArrowRight: [0, -1],
};

/**
 * The keys that are held to drive a robot. The page listens to them from its first moment on, not from when a panel has
 * been drawn: a key that is pressed right after driving began counts.
 */
export class DrivingKeys {
  private readonly held = new Set<string>();

  /** @p isOn: whether keys drive now. */
  constructor(target: EventTarget, private readonly isOn: () => boolean) {
    const listen = (event: Event) => this.take(event as KeyboardEvent);
    target.addEventListener("keydown", listen, true);
    target.addEventListener("keyup", listen, true);
    target.addEventListener("blur", () => this.clear());
  }

  /** Forwards and to the left, each the sum of the keys that are held. */
  way(): { v: number; w: number } {
    let [v, w] = [0, 0];
    for (const key of this.held) {
      v += kWays[key]![0];
      w += kWays[key]![1];
    }
    return { v, w };
  }

  clear(): void {
    this.held.clear();
  }

  private take(event: KeyboardEvent): void {
    const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    if (!kWays[key]) return;
    if (event.type === "keyup") this.held.delete(key);
    if (!this.isOn() || event.ctrlKey || event.metaKey || event.altKey) return;
    if (isTypedInto(event.target)) return;
    event.preventDefault();
    // Who holds the key that began to drive does not steer by it.
    if (event.type === "keydown" && !event.repeat) this.held.add(key);
  }
}
