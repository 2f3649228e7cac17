import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { mostBytes, sentName } from "../src/link/openFile";
import { Board } from "../src/model/Board";
import { FileOpening } from "../src/model/FileOpening";

/** An XMLHttpRequest whose answer the test gives. */
class Request {
  static last: Request;
  upload: { onprogress?: (event: { loaded: number; total: number }) => void; onload?: () => void } = {};
  onload = () => {};
  onerror = () => {};
  onabort = () => {};
  status = 0;
  responseText = "";
  said: string[] = [];
  constructor() {
    Request.last = this;
  }
  open(verb: string, url: string) {
    this.said.push(`${verb} ${url}`);
  }
  setRequestHeader(name: string, value: string) {
    this.said.push(`${name}: ${value}`);
  }
  send() {
    this.said.push("sent");
  }
  abort() {
    this.onabort();
  }
  answer(status: number, text: string) {
    Object.assign(this, { status, responseText: text });
    this.onload();
  }
}

const answers = (status: number, text: string) => vi.fn(async () => new Response(text, { status }));

describe("a file of the user", () => {
  beforeEach(() => {
    Request.last = undefined as never;
    vi.stubGlobal("XMLHttpRequest", Request);
  });
  afterEach(() => void vi.unstubAllGlobals());

  const operator = () => Object.assign(new Board(), { link: "open", role: "operator", kind: "record" });
  const opened = (board: Board, url: string | null = "http://here/open") => new FileOpening({ board, url, token: () => "abc" });
  const file = new File(["12345"], "my run.rec");

  it("is sent with its name and the token, and is told how far it is", async () => {
    vi.stubGlobal("fetch", answers(200, "most=100\n"));
    const opening = opened(operator());
    const done = opening.open([file], true);
    await vi.waitFor(() => expect(Request.last?.said.at(-1)).toBe("sent"));
    expect(Request.last.said).toEqual(["POST http://here/open?name=my_run.rec&beside=1", "Authorization: Bearer abc", "Content-Type: application/octet-stream", "sent"]);
    Request.last.upload.onprogress!({ loaded: 2, total: 5 });
    expect(opening.state).toEqual({ phase: "sending", name: "my run.rec", share: 0.4 });
    Request.last.upload.onload!();
    expect(opening.state).toEqual({ phase: "reading", name: "my run.rec" });
    const before = Request.last;
    await opening.open([file], false); // one at a time
    expect(Request.last).toBe(before);
    Request.last.answer(200, "opened\n");
    await done;
    expect(opening.state).toEqual({ phase: "none" });
  });

  it("is refused in the program's words, which can be forgotten", async () => {
    vi.stubGlobal("fetch", answers(200, "most=100\n"));
    const opening = opened(operator());
    const done = opening.open([file], false);
    await vi.waitFor(() => expect(Request.last?.said.at(-1)).toBe("sent"));
    Request.last.answer(415, "my_run.rec is a robot file\n");
    await done;
    expect(opening.state).toEqual({ phase: "failed", text: "my_run.rec is a robot file" });
    opening.forget();
    expect(opening.state).toEqual({ phase: "none" });
  });

  it("can be given up while it is sent", async () => {
    vi.stubGlobal("fetch", answers(200, "most=100\n"));
    const opening = opened(operator());
    const done = opening.open([file], false);
    await vi.waitFor(() => expect(Request.last?.said.at(-1)).toBe("sent"));
    opening.cancel();
    await done;
    expect(opening.state).toEqual({ phase: "none" });
  });

  it("is not sent where it can't be opened, and why is said", async () => {
    const whyNot = async (opening: FileOpening, files = [file]) => {
      await opening.open(files, false);
      return opening.state.phase === "failed" ? opening.state.text : opening.state.phase;
    };
    vi.stubGlobal("XMLHttpRequest", undefined);
    vi.stubGlobal("fetch", answers(200, "most=4\n"));
    expect(await whyNot(opened(operator(), null))).toMatch(/no program behind it.*ortung view my run\.rec/);
    expect(await whyNot(opened(operator()))).toMatch(/more than/);
    expect(await whyNot(opened(operator()), [file, file])).toMatch(/^2 files/);
    expect(await whyNot(opened(operator()), [])).toBe("none");
    vi.stubGlobal("fetch", answers(200, "most=100\n"));
    expect(await whyNot(opened(Object.assign(operator(), { role: "viewer" })))).toMatch(/operators/);
    vi.stubGlobal("fetch", answers(404, "There is no such file here.\n"));
    expect(await whyNot(opened(operator()))).toMatch(/opens no files.*ortung view/);
  });

  it("has a name that is one everywhere", () => {
    expect(sentName("run.rec")).toBe("run.rec");
    expect(sentName("../../etc/pass wd")).toBe("_.._etc_pass_wd");
    expect(sentName("...")).toBe("file");
    expect(sentName("")).toBe("file");
    expect(sentName("ü&beside=1#x")).toBe("__beside_1_x");
    expect(sentName(`${"a".repeat(300)}.mcap`)).toMatch(/^a{95}\.mcap$/);
  });

  it("may be as large as the program says, if it says so", async () => {
    for (const [status, text, most] of [[200, "most=12\n", 12], [200, "<html>", null], [404, "most=12", null], [200, "most=1e9", null]] as const) {
      vi.stubGlobal("fetch", answers(status, text));
      expect(await mostBytes("open")).toBe(most);
    }
    vi.stubGlobal("fetch", vi.fn(async () => Promise.reject(new TypeError("failed"))));
    expect(await mostBytes("open")).toBeNull();
  });
});
