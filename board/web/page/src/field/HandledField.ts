import type { Point, Pose } from "../model/geometry";
import type { Context } from "../ui/context";
import type { Overlay } from "./Overlay";
import type { View } from "./View";

/** What hands reach of a drawn field. */
export interface HandledField {
  readonly context: Context;
  readonly svg: SVGSVGElement;
  readonly view: View;
  readonly overlay: Overlay;
  /** Where the user holds something, by what names it in the protocol. */
  readonly held: Map<string, Pose>;
  /** The heading to ask for at a place: that of the map, or of the selected robot. */
  readonly askedHeading: number;
  /** Has everything drawn again. */
  dirty(): void;
  zoomBy(factor: number, at?: Point): void;
  /** Where a place is, in words. */
  describe(at: Point): string;
}
