import type { Head } from "./words";

/** Numbers of a reading as `ortung export html` rounds them: mm or 1/100 degree; "inf": beyond the range; null: none. */
type Rounded = number | "inf" | null;

/** Maps and reasons of one moment of a run, as the page holds them. */
interface Moment {
  maps: {
    feature: string; scale: string; stamp: number; columns: number; rows: number; x_min_m: number; y_min_m: number;
    step_m: number; low: number; high: number; readings: number; bytes: string;
  }[];
  why: {
    /** `angles`: 1 where a value is an angle. */
    features: { name: string; measured: Rounded[]; angles: number[] }[];
    /** x, y [mm], theta [1/100 degree]. */
    places: { x: number; y: number; theta: number; p: number; ps: number[]; expected: Rounded[][] }[];
  };
}

/** A moment that has maps: its time [us], and the rest compressed. */
export interface PackedMoment {
  us: number;
  data: string;
}

export type Answer = { words: string; lines?: string[]; bytes?: Uint8Array } | { error: string };

const kMostPlaces = 1e4;

/** What a run within the page can answer of HEATMAP and WHY: of the moments that were computed when it was exported. */
export class KeptMaps {
  private unpackedAt = -1;
  private unpacked: Promise<Moment> | null = null;

  constructor(
    private readonly moments: PackedMoment[],
    private readonly unpack: (base64: string) => Promise<string>,
  ) {}

  get stamps(): number[] {
    return this.moments.map(({ us }) => us);
  }

  /** The moment next to @p time. */
  private nearest(time: number): PackedMoment {
    return this.moments.reduce((best, one) => (Math.abs(one.us - time) < Math.abs(best.us - time) ? one : best));
  }

  private at(time: number): Promise<Moment> {
    const { us, data } = this.nearest(time);
    if (this.unpackedAt !== us || !this.unpacked) {
      this.unpackedAt = us;
      this.unpacked = this.unpack(data).then((text) => JSON.parse(text) as Moment);
    }
    return this.unpacked;
  }

  async map(time: number, { words, keys }: Head, robot: number): Promise<Answer> {
    if (keys.has("theta_deg") || keys.has("of")) {
      return { error: "argument an exported page has maps of p at the most probable heading alone; ortung view has all" };
    }
    if (words.length > 1) return { error: "argument an exported page has maps of all features, and of each; ortung view has all" };
    const [feature = ""] = words;
    const scale = keys.get("scale") ?? "linear";
    const map = (await this.at(time)).maps.find((one) => one.feature === feature && one.scale === scale);
    if (!map) return { error: `argument there is no map of ${feature}` };
    const { bytes, feature: _, scale: __, ...rest } = map;
    const told = Object.entries(rest).map(([key, value]) => `${key}=${value}`);
    return {
      words: `robot=${robot} moment=${this.nearest(time).us} ${told.join(" ")}`,
      bytes: Uint8Array.from(atob(bytes), (c) => c.charCodeAt(0)),
    };
  }

  /** Why, at the place next to the one that is asked for, which the answer names. */
  async why(time: number, { keys }: Head, robot: number): Promise<Answer> {
    const [x, y] = [Number(keys.get("x_m")) * 1000, Number(keys.get("y_m")) * 1000];
    if (!Number.isFinite(x) || !Number.isFinite(y)) return { error: "syntax WHY needs a pose, x_m=X y_m=Y theta_deg=T" };
    const { why } = await this.at(time);
    const places = why.places.slice(0, kMostPlaces);
    if (!places.length) return { error: "state this moment says of no place why" };
    const far = (place: { x: number; y: number }) => Math.hypot(place.x - x, place.y - y);
    const place = places.reduce((best, one) => (far(one) < far(best) ? one : best));
    const lines: string[] = [];
    why.features.forEach(({ name, measured, angles }, i) => {
      lines.push(`${name} p=${place.ps[i]} values=${measured.length}`);
      measured.forEach((value, k) => {
        const isAngle = angles[k] === 1;
        const seen = told("measured", value, isAngle) + told("expected", place.expected[i]?.[k] ?? null, isAngle);
        lines.push(`value ${name} ${k} unit=${isAngle ? "rad" : "m"}${seen}`);
      });
    });
    const at = `x_m=${place.x / 1000} y_m=${place.y / 1000} theta_deg=${place.theta / 100}`;
    return { words: `robot=${robot} p=${place.p} moment=${this.nearest(time).us} ${at}`, lines };
  }
}

function told(key: string, value: Rounded, isAngle: boolean): string {
  if (value === null) return "";
  if (value === "inf") return ` ${key}=inf`;
  return ` ${key}=${isAngle ? ((value / 100) * Math.PI) / 180 : value / 1000}`;
}
