import type { Pose } from "./geometry";
import type { Kind } from "./kinds";

/** What a robot senses. Feature names are MODEL/TYPE/FEATURE. */
export interface Feature {
  name: string;
  /** For people alone. */
  text: string;
  kind: Kind;
  mount: Pose;
}

/** A robot's estimate of its pose; other poses with sigmas are those of sensors. */
export const kEstimate = "mcl/LOCALIZATION/pose";
