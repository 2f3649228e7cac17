import { describe, expect, it } from "vitest";
import { parseAddress, toFragment } from "../src/link/address";
import { Robot } from "../src/model/Robot";
import { Story } from "../src/model/story";
import { inWords } from "../src/model/why";

const kReasons = ["readings_fit", "several_places_fit", "the_belief_is_spread", "the_field_is_searched", "few_readings"];
const kPlaces = "mcl/LOCALIZATION/places";
const kStatus = "mcl/LOCALIZATION/status";

function robot(): Robot {
  const made = new Robot(1);
  made.describe([
    `${kStatus} text`, `${kPlaces} text`, `format ${kPlaces} clusters`,
    `format ${kStatus} track status=tracking,uncertain,lost reason=${kReasons.join(",")} cause=none`,
  ]);
  return made;
}

function say(made: Robot, status: number, reason: number, shares: number[] = []): void {
  made.readings.set(kStatus, { stamp: 0, words: Uint32Array.from([status, reason, 9000, 5000, 0, 0]) });
  const middle = 2 ** 31;
  const words = shares.flatMap((share) => [share * 100, middle, middle, 18000, 0, 0, 0, 10000, 10000, 10000]);
  made.readings.set(kPlaces, { stamp: 0, words: Uint32Array.from(words) });
}

describe("the story of a localization", () => {
  it("tells what is not decided, and that it is over", () => {
    const [story, made] = [new Story(), robot()];
    expect(story.tell(made, 0)).toBe("");
    say(made, 2, 3);
    expect(story.tell(made, 0)).toBe("It may be anywhere: the whole field is searched.");
    say(made, 1, 1, [52, 47, 1]);
    expect(story.tell(made, 1e6)).toBe("2 places fit what it senses (52 %, 47 %): it can't tell them apart yet.");
    say(made, 1, 4);
    expect(story.tell(made, 4e6)).toBe("Not sure yet: few readings.");
    say(made, 0, 0, [100]);
    expect(story.tell(made, 8.5e6)).toBe("Found: of 2 places one is left, after 8.5 s.");
    expect(story.tell(made, 18e6)).toMatch(/^Found/);
    expect(story.tell(made, 18.6e6)).toBe("");
    say(made, 1, 4);
    expect(story.tell(made, 20e6)).toBe(""); // a doubt that is none of the place
  });

  it("begins anew when time does", () => {
    const [story, made] = [new Story(), robot()];
    say(made, 1, 1, [50, 50]);
    story.tell(made, 5e6);
    say(made, 0, 0, [100]);
    expect(story.tell(made, 1e6)).toBe("");
    say(made, 2, 3);
    story.tell(made, 2e6);
    say(made, 0, 0, [100]);
    expect(story.tell(made, 2.5e6)).toBe("Found, after 0.5 s.");
  });
});

describe("a probability in words", () => {
  it("compares with the best place of the field", () => {
    expect(inWords(6.6e-22, 3.2e-3)).toBe("Practically ruled out: 10¹⁹ times less probable than the best place of the field.");
    expect(inWords(0.2, 0.4)).toMatch(/^Possible: 2 times less/);
    expect(inWords(0.3, 0.4)).toMatch(/^About as probable/);
    expect(inWords(1e-4, 0.4)).toMatch(/^Improbable: 10000 times less/);
    expect(inWords(0.9, 0.4)).toMatch(/^More probable|^About/);
    expect(inWords(0, 0.4)).toMatch(/^Impossible beside/);
    expect(inWords(-1, 0.4)).toMatch(/^No feature/);
    expect(inWords(0.3, null)).toMatch(/^Show a map/);
    expect(inWords(0, 0)).toMatch(/too small for a number/);
  });
});

describe("the address of the demo", () => {
  it("keeps that it is one", () => {
    const address = parseAddress("#token=abc&panel=localization&demo=1");
    expect(address.demo).toBe(true);
    expect(parseAddress(toFragment(address)).demo).toBe(true);
    expect(parseAddress("#token=abc").demo).toBe(false);
  });
});
