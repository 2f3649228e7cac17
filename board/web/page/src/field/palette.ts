/** Colours that people with any colour vision tell apart (Okabe and Ito 2008). */
export const kSafe = ["#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#d55e00", "#f0e442"];

const kTeams: Record<string, string> = {
  blue: "#0072b2",
  yellow: "#f0c020",
  cyan: "#56b4e9",
  magenta: "#cc79a7",
  red: "#d55e00",
  green: "#009e73",
};

/** The colour of a team: its own if it is named by one, else the same one each time. */
export function teamColour(team: string): string {
  if (team === "") return "#8a93a3";
  const named = kTeams[team.toLowerCase()];
  if (named) return named;
  let sum = 0;
  for (const letter of team) sum = (sum * 31 + letter.codePointAt(0)!) % 9973;
  return kSafe[sum % kSafe.length]!;
}

/** A robot's colour: of its team, of itself, or, of runs side by side, one that no other run has. */
export function robotColour(robot: { team: string; number: number }, isRun: boolean, own = ""): string {
  if (robot.team) return teamColour(robot.team);
  if (own) return paint(own);
  return isRun ? kSafe[(robot.number - 1) % kSafe.length]! : teamColour("");
}

/** Names of colours that worlds use, as they look good on the floor. */
const kNamed: Record<string, string> = {
  white: "#f4f6f4", black: "#16181c", blue: "#2f7fd0", yellow: "#f0c020", green: "#3f9b5f", red: "#c9482b",
  orange: "#ff8c1a", cyan: "#56b4e9", magenta: "#cc79a7", grey: "#8a93a3", gray: "#8a93a3", brown: "#8d6748",
};

export function paint(colour: string): string {
  return colour.startsWith("#") ? colour : (kNamed[colour.toLowerCase()] ?? kNamed.grey!);
}

/** Lightness grows evenly along it, for all eyes: five stops from dark blue to yellow. */
const kStops = [
  [68, 1, 84],
  [59, 82, 139],
  [33, 145, 140],
  [94, 201, 98],
  [253, 231, 37],
] as const;

/** 256 colours of four bytes for the values of a heat map; the first one, "not open", is clear. */
export function heatPalette(opacity: number): Uint8Array {
  const palette = new Uint8Array(256 * 4);
  for (let i = 1; i < 256; ++i) {
    const at = ((i - 1) / 254) * (kStops.length - 1);
    const stop = Math.min(kStops.length - 2, Math.floor(at));
    const share = at - stop;
    for (let c = 0; c < 3; ++c) {
      palette[4 * i + c] = Math.round(kStops[stop]![c]! * (1 - share) + kStops[stop + 1]![c]! * share);
    }
    palette[4 * i + 3] = Math.round(255 * opacity);
  }
  return palette;
}

/** Of a building's floor only where it is free has a colour of its own: a light over whatever the page is below. */
export function floorPalette(): Uint8Array {
  const palette = new Uint8Array(256 * 4);
  palette.set([255, 255, 255, 255], 255 * 4);
  return palette;
}
