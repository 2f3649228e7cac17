/** Layers of the field's drawing, some of them of the selected robot alone. */
export interface Layers {
  names: boolean;
  trails: boolean;
  way: boolean;
  along: boolean;
  rays: boolean;
  sightings: boolean;
  expected: boolean;
  samples: boolean;
  places: boolean;
  changes: boolean;
  bound: boolean;
  estimate: boolean;
  ghost: boolean;
  legend: boolean;
}

export const kLayers: Record<keyof Layers, { label: string; about: string; on: boolean }> = {
  names: { label: "names", about: "names of robots", on: true },
  trails: { label: "trails", about: "where robots have been", on: false },
  way: { label: "whole way", about: "where robots are in all of a record", on: true },
  along: { label: "scans along it", about: "some scans of all of a record, where the selected robot took them", on: false },
  rays: { label: "rays", about: "scans and sonar cones of the selected robot", on: true },
  sightings: { label: "sightings", about: "landmarks, objects and points that the selected robot sees", on: true },
  expected: { label: "expected", about: "what the features should read where the robot is", on: false },
  samples: { label: "samples", about: "samples of the filter, as arrows by their weight", on: true },
  places: { label: "places", about: "clusters of samples, as ellipses of two sigmas", on: true },
  changes: { label: "changes", about: "cells where the map no longer fits: walls that are gone, and what is new", on: true },
  bound: { label: "bound", about: "a ring about the estimate that the error leaves once in a thousand while tracking", on: true },
  estimate: { label: "estimate", about: "the filter's estimate of the robot's pose", on: true },
  ghost: { label: "odometry", about: "the pose by odometry alone", on: false },
  legend: { label: "legend", about: "what the colours mean", on: true },
};

export const kLayerNames = Object.keys(kLayers) as (keyof Layers)[];

/** A layer that the page chooses itself, by what a record holds. */
const isOfRecord = (name: keyof Layers) => name === "along";

/** The layers that are on, for others to have the same; null: those that usually are. */
export function sharedLayers(layers: Layers): string[] | null {
  const names = kLayerNames.filter((name) => !isOfRecord(name));
  return names.every((name) => layers[name] === kLayers[name].on) ? null : names.filter((name) => layers[name]);
}

/** Layers as somebody has shared them; names that are unknown say nothing. */
export function withShared(layers: Layers, names: string[] | null): Layers {
  const next = { ...layers };
  for (const name of kLayerNames) if (!isOfRecord(name)) next[name] = names ? names.includes(name) : kLayers[name].on;
  return next;
}
