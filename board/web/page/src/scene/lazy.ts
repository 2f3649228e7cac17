import type { Context } from "../ui/context";
import type { Scene3dHandle } from "./Scene3d";

/** The 3-D view and its library are loaded when they are asked for. */
export function lazyScene3d(): Promise<{ startScene3d(place: HTMLElement, context: Context): Scene3dHandle }> {
  return import("./Scene3d");
}
