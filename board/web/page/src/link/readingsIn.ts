/** One reading of a feature: its time stamp [us], its three names, its words. */
export interface Reading {
  stamp: number;
  feature: string;
  words: Uint32Array;
}

const kMostWords = 16_777_216;
const text = new TextDecoder("latin1");

/** The readings of a binary block. What comes behind the first one that is none is left out. */
export function readingsInBytes(bytes: Uint8Array): Reading[] {
  const readings: Reading[] = [];
  let at = 0;
  while (at < bytes.length) {
    const end = bytes.indexOf(10, at);
    if (end < 0) break;
    const parts = text.decode(bytes.subarray(at, end)).split(" ");
    const stamp = Number(parts[0]);
    const count = Number(parts[2]);
    const isReading =
      parts.length === 3 && Number.isFinite(stamp) && Number.isInteger(count) && count >= 0 && count <= kMostWords;
    const begin = end + 1;
    if (!isReading || begin + count * 4 > bytes.length) break;
    // A copy, since words must begin at a multiple of four. The order of bytes is that of all
    // machines on which browsers run: the lowest first.
    const words = new Uint32Array(bytes.slice(begin, begin + count * 4).buffer);
    readings.push({ stamp, feature: parts[1]!, words });
    at = begin + count * 4;
  }
  return readings;
}

/** The reading of a line of text, or null if the line is none. */
export function readingInLine(line: string): Reading | null {
  const parts = line.split(" ");
  const stamp = Number(parts[0]);
  const count = Number(parts[2]);
  if (parts.length < 3 || !Number.isFinite(stamp) || parts.length !== 3 + count) return null;
  const words = new Uint32Array(count);
  for (let i = 0; i < count; ++i) {
    const word = Number(parts[3 + i]);
    if (!Number.isInteger(word) || word < 0 || word > 0xffffffff) return null;
    words[i] = word;
  }
  return { stamp, feature: parts[1]!, words };
}

export function readingsOf(message: { lines: string[]; bytes: Uint8Array | null }): Reading[] {
  if (message.bytes) return readingsInBytes(message.bytes);
  return message.lines.map(readingInLine).filter((reading) => reading !== null);
}
