import type { Context } from "../app/context";

export interface Scene3dHandle {
  stop(): void;
}

/** The 3-D view and its library are loaded when they are asked for. */
export function lazyScene3d(): Promise<{ startScene3d(place: HTMLElement, context: Context): Scene3dHandle }> {
  return import("./Scene3d");
}
