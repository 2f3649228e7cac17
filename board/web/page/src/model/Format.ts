/** What the words of a feature are, as a line `format` says it: a name and parameters. */
export interface Format {
  name: string;
  parameters: Map<string, string>;
}

const kName = /^[a-z0-9_]{1,64}$/;
const kValue = /^[\x21-\x7e]+$/;
const kLongest = 900;
const kMostParameters = 32;

/** Reads "NAME key=value key=value ..."; null if it is anything else. */
export function parseFormat(text: string): Format | null {
  if (text.length > kLongest) return null;
  const [name = "", ...pairs] = text.split(" ");
  if (!kName.test(name) || pairs.length > kMostParameters) return null;
  const parameters = new Map<string, string>();
  for (const pair of pairs) {
    const [, key = "", value = ""] = /^([^=]*)=(.*)$/s.exec(pair) ?? [];
    if (!kName.test(key) || !kValue.test(value) || parameters.has(key)) return null;
    parameters.set(key, value);
  }
  return { name, parameters };
}

/** A finite number of a parameter; null if there is none. */
export function numberIn({ parameters }: Format, key: string): number | null {
  const value = Number(parameters.get(key) ?? NaN);
  return Number.isFinite(value) ? value : null;
}

/** What stands between the commas of a parameter; none if it is not there. */
export function listIn({ parameters }: Format, key: string): string[] {
  return parameters.get(key)?.split(",") ?? [];
}
