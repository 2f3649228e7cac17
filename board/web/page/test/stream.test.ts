import { describe, expect, it } from "vitest";
import { StreamParser, type Message } from "../src/link/StreamParser";
import { readingInLine, readingsInBytes } from "../src/link/readingsIn";
import { parseHead, plain } from "../src/link/words";

const bytesOf = (text: string) => new TextEncoder().encode(text);

function parse(pieces: Uint8Array[]): Message[] {
  const messages: Message[] = [];
  const parser = new StreamParser((message) => messages.push(message));
  pieces.forEach((piece) => parser.push(piece));
  return messages;
}

const kBinary = new Uint8Array([...bytesOf("7 a/b/c 2\n"), 10, 0, 0, 0, 255, 255, 255, 255]);
const kSession = new Uint8Array([
  ...bytesOf("#v1 OK HELLO ortung/1 role=viewer now=0\n* SAY client=2 name=a lines=3 of mine\n"),
  ...bytesOf(`* UPDATE robot=0 now=5 bytes=${kBinary.length} readings=1\n`),
  ...kBinary,
  ...bytesOf("#v2 OK LIST lines=2\nrobot=1\nlines=9 of text\n#v3 ERR number lines=4 is wrong\n\n#v4 OK LIST lines=0\n"),
]);

describe("the stream of a message board", () => {
  it("is the same however it is cut", () => {
    const whole = parse([kSession]);
    for (const size of [1, 2, 3, 7, 64]) {
      const pieces: Uint8Array[] = [];
      for (let at = 0; at < kSession.length; at += size) pieces.push(kSession.slice(at, at + size));
      expect(parse(pieces)).toEqual(whole);
    }
    expect(whole.map(({ line }) => line.split(" ")[0])).toEqual(["#v1", "*", "*", "#v2", "#v3", "#v4"]);
  });

  it("keeps lines and bytes with the reply that announced them", () => {
    const [, , update, list] = parse([kSession]);
    expect(update!.bytes).toEqual(kBinary);
    expect(list!.lines).toEqual(["robot=1", "lines=9 of text"]);
  });

  it("shows what is no character, or turns the text around it, as such", () => {
    const bytes = [...bytesOf("name=a\u202eb\u0000c\u001bd\u2066e\u200ff"), 0xed, 0xa0, 0x80, ...bytesOf("g\u00e9 h\n")];
    expect(parse([new Uint8Array(bytes)])[0]!.line).toBe("name=a\ufffdb\ufffdc\ufffdd\ufffde\ufffdf\ufffd\ufffd\ufffdg\u00e9 h");
  });

  it("holds blocks that are larger than its first buffer", () => {
    const large = new Uint8Array(300_000).fill(10);
    const messages = parse([bytesOf("#v1 OK X bytes=300000\n"), large.slice(0, 1000), large.slice(1000), bytesOf("#v2 OK Y\n")]);
    expect(messages.map(({ bytes }) => bytes?.length)).toEqual([300_000, undefined]);
  });

  it("refuses what can't be meant", () => {
    expect(() => parse([bytesOf("#v1 OK X bytes=999999999\n")])).toThrow(/announces 999999999 bytes/);
    expect(() => parse([bytesOf("x".repeat(5 * 1024 * 1024))])).toThrow(/longer than 4 MiB/);
  });
});

describe("readings", () => {
  it("come from binary blocks", () => {
    expect(readingsInBytes(kBinary)).toEqual([{ stamp: 7, feature: "a/b/c", words: new Uint32Array([10, 4294967295]) }]);
  });

  it("end where a block is cut", () => {
    expect(readingsInBytes(kBinary.slice(0, -1))).toEqual([]);
    expect(readingsInBytes(bytesOf("7 a/b/c 999999999\n"))).toEqual([]);
  });

  it("come from lines, unless a word is none", () => {
    expect(readingInLine("5 a/b/c 2 1 2")?.words).toEqual(new Uint32Array([1, 2]));
    for (const line of ["5 a/b/c 2 1", "5 a/b/c 1 -1", "5 a/b/c 1 4294967296", "x a/b/c 0", "5"]) {
      expect(readingInLine(line)).toBeNull();
    }
  });
});

describe("words", () => {
  it("are told from keys", () => {
    const { words, keys } = parseHead("UPDATE robot=2 a=b=c =x");
    expect(words).toEqual(["UPDATE", "=x"]);
    expect([...keys]).toEqual([["robot", "2"], ["a", "b=c"]]);
  });

  it("are plain decimals when they are numbers", () => {
    expect([0, -0, 1.5, 1e-9, 100, -2.25].map(plain)).toEqual(["0", "0", "1.5", "0", "100", "-2.25"]);
    expect(() => plain(NaN)).toThrow();
  });
});
