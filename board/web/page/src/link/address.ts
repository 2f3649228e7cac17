/** What the page's address says behind `#`: a token, and where to look. */
export interface Address {
  token: string;
  robot: number | null;
  follow: boolean;
  panel: string | null;
  /** Shows how a robot finds its place, from the beginning. */
  demo: boolean;
  /** How the page is arranged, as layout/text.ts writes it; null: as it was kept. Hostile. */
  layout: string | null;
}

export function parseAddress(fragment: string): Address {
  const keys = new URLSearchParams(fragment.replace(/^#/, ""));
  const robot = Number(keys.get("robot") ?? "");
  return {
    token: /^[\x21-\x7e]{1,256}$/.test(keys.get("token") ?? "") ? keys.get("token")! : "",
    robot: Number.isInteger(robot) && robot > 0 ? robot : null,
    follow: keys.get("follow") === "1",
    panel: keys.get("panel"),
    demo: keys.get("demo") === "1",
    layout: keys.get("layout"),
  };
}

/** The fragment that brings another one to the same view. */
export function toFragment(address: Address): string {
  const keys = new URLSearchParams();
  if (address.token) keys.set("token", address.token);
  if (address.robot) keys.set("robot", String(address.robot));
  if (address.follow) keys.set("follow", "1");
  if (address.panel) keys.set("panel", address.panel);
  if (address.demo) keys.set("demo", "1");
  if (address.layout) keys.set("layout", address.layout);
  return keys.size ? `#${keys}` : "";
}

/** Where the message board is: beside the page. */
export function boardAddress(location: { protocol: string; host: string; pathname: string }): string {
  const scheme = location.protocol === "https:" ? "wss:" : "ws:";
  const folder = location.pathname.replace(/[^/]*$/, "");
  return `${scheme}//${location.host}${folder}board`;
}

/** Where files are sent that are to be opened: beside the page. */
export const fileAddress = ({ origin, pathname }: { origin: string; pathname: string }): string =>
  `${origin}${pathname.replace(/[^/]*$/, "")}open`;

/** What is said first. Who has the token steers; others look, under a name that needs none. */
export function greeting(token: string, role: "viewer" | "operator"): string {
  return `HELLO ortung/1 ${token ? `name=view role=${role} token=${token}` : "name=look role=viewer"}`;
}
