import { wrap, type Pose } from "./geometry";

/** Where something was at a time [us]. */
export type Moment = Pose & { stamp: number };

/** Who moved farther in one step was carried. */
export const kJump = 0.6;

/** Who was carried away meanwhile was at one place or the other, never between them. */
export function between(before: Moment, behind: Moment, stamp: number): Pose {
  if (Math.hypot(behind.x - before.x, behind.y - before.y) > kJump) {
    return stamp - before.stamp < behind.stamp - stamp ? before : behind;
  }
  const share = behind.stamp > before.stamp ? (stamp - before.stamp) / (behind.stamp - before.stamp) : 1;
  return {
    x: before.x + share * (behind.x - before.x),
    y: before.y + share * (behind.y - before.y),
    theta: wrap(before.theta + share * wrap(behind.theta - before.theta)),
  };
}

/** Where it was at @p stamp: null outside of the moments, and where they are more than @p most [us] apart. */
export function momentAt(moments: Moment[], stamp: number, most = 2e6): Pose | null {
  let low = 0;
  let high = moments.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (moments[middle]!.stamp < stamp) low = middle + 1;
    else high = middle;
  }
  const behind = moments[low];
  if (!behind) return null;
  if (behind.stamp === stamp) return behind;
  const before = moments[low - 1];
  if (!before || behind.stamp - before.stamp > most) return null;
  return between(before, behind, stamp);
}

/** How much a record has of a feature. Times [us]. */
export interface Content {
  feature: string;
  readings: number;
  first: number;
  last: number;
}

/** All of a record's poses, of each kind. */
export interface Way {
  truth: Moment[];
  estimate: Moment[];
  odometry: Moment[];
}

/** The poses that say best where the robot was. */
export function bestOf(way: Way): Moment[] {
  return way.truth.length ? way.truth : way.estimate.length ? way.estimate : way.odometry;
}
