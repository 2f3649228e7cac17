import { expect, it } from "vitest";
import { DrivingKeys } from "../src/ui/DrivingKeys";

function press(target: EventTarget, type: string, key: string, more = {}): Event {
  const event = Object.assign(new Event(type, { cancelable: true }), { key, repeat: false }, more);
  target.dispatchEvent(event);
  return event;
}

it("counts a key from the moment on at which keys drive", () => {
  let isOn = false;
  const target = new EventTarget();
  const keys = new DrivingKeys(target, () => isOn);
  expect(press(target, "keydown", "d").defaultPrevented).toBe(false);
  isOn = true;
  press(target, "keydown", "d", { repeat: true });
  expect(keys.way()).toEqual({ v: 0, w: 0 });
  expect(press(target, "keydown", "a").defaultPrevented).toBe(true);
  press(target, "keydown", "ArrowUp");
  expect(keys.way()).toEqual({ v: 1, w: 1 });
  press(target, "keyup", "A");
  expect(keys.way()).toEqual({ v: 1, w: 0 });
  press(target, "blur", "");
  expect(keys.way()).toEqual({ v: 0, w: 0 });
});

it("leaves alone what is typed with control keys, or is no way", () => {
  const target = new EventTarget();
  const keys = new DrivingKeys(target, () => true);
  expect(press(target, "keydown", "a", { ctrlKey: true }).defaultPrevented).toBe(false);
  expect(press(target, "keydown", "x").defaultPrevented).toBe(false);
  expect(keys.way()).toEqual({ v: 0, w: 0 });
});

it("forgets a key that is let go after keys have ceased to drive", () => {
  let isOn = true;
  const target = new EventTarget();
  const keys = new DrivingKeys(target, () => isOn);
  press(target, "keydown", "w");
  isOn = false;
  press(target, "keyup", "w");
  expect(keys.way()).toEqual({ v: 0, w: 0 });
});
