/** What became of a file that was sent to the program. */
export interface Opened {
  isOpened: boolean;
  text: string;
}

const kLongest = 100;

/** A file's name as the program takes it: letters, digits and `._-`, the end of a long one, with no dot at its beginning. */
export function sentName(name: string): string {
  const plain = name.replace(/[^A-Za-z0-9._-]/g, "_").slice(-kLongest).replace(/^\.+/, "");
  return plain || "file";
}

/** The largest file that the program behind the page opens [bytes]; null if it opens none. */
export async function mostBytes(url: string): Promise<number | null> {
  const answer = await fetch(url).catch(() => null);
  const found = answer?.ok ? /^most=(\d{1,15})\s*$/.exec(await answer.text()) : null;
  return found ? Number(found[1]) : null;
}

/** A file on its way to the program behind the page. */
export interface Sending {
  done: Promise<Opened>;
  cancel(): void;
}

/** @param onShare told how much of it was sent, in [0, 1] */
export function sendFile(url: string, file: File, token: string, isBeside: boolean, onShare: (share: number) => void): Sending {
  const request = new XMLHttpRequest(); // fetch tells nothing of how far it is
  const done = new Promise<Opened>((resolve) => {
    const fail = (text: string) => () => resolve({ isOpened: false, text });
    request.upload.onprogress = ({ loaded, total }) => onShare(total > 0 ? loaded / total : 0);
    request.upload.onload = () => onShare(1);
    request.onload = () => resolve({ isOpened: request.status === 200, text: request.responseText.trim() });
    request.onerror = fail("the connection to the program was lost, or the file can't be read");
    request.onabort = fail("cancelled");
  });
  request.open("POST", `${url}?name=${sentName(file.name)}${isBeside ? "&beside=1" : ""}`);
  request.setRequestHeader("Authorization", `Bearer ${token}`);
  request.setRequestHeader("Content-Type", "application/octet-stream");
  request.send(file);
  return { done, cancel: () => request.abort() };
}
