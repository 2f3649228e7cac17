/** The head of a line of the message board: words and key=value pairs. */
export interface Head {
  words: string[];
  keys: Map<string, string>;
}

const kKey = /^([A-Za-z][A-Za-z0-9_]*)=(.*)$/;

export function parseHead(text: string): Head {
  const words: string[] = [];
  const keys = new Map<string, string>();
  for (const word of text.split(" ")) {
    if (word === "") continue;
    const match = kKey.exec(word);
    if (match) keys.set(match[1]!, match[2]!);
    else words.push(word);
  }
  return { words, keys };
}

/** A finite number of a key, or what is given instead. */
export function numberOf(keys: Map<string, string>, key: string, otherwise: number): number {
  const text = keys.get(key);
  if (text === undefined || text === "") return otherwise;
  const value = Number(text);
  return Number.isFinite(value) ? value : otherwise;
}

/** A number as the protocol takes it: plain decimals, at most six of them. */
export function plain(value: number): string {
  if (!Number.isFinite(value)) throw new Error("only finite numbers can be sent");
  const text = value.toFixed(6).replace(/\.?0+$/, "");
  return text === "-0" ? "0" : text;
}
