/** Poses and angles in the plane: x, y [m], theta [rad], counter-clockwise. */
export interface Pose {
  x: number;
  y: number;
  theta: number;
}

export interface Point {
  x: number;
  y: number;
}

/** An angle in (-pi, pi]. */
export function wrap(angle: number): number {
  const turned = angle - 2 * Math.PI * Math.floor((angle + Math.PI) / (2 * Math.PI));
  return turned === -Math.PI ? Math.PI : turned;
}

/** Where @p inner is, seen from the frame that @p outer is given in. */
export function compose(outer: Pose, inner: Pose): Pose {
  const { x, y } = place(outer, inner);
  return { x, y, theta: wrap(outer.theta + inner.theta) };
}

export function place(outer: Pose, inner: Point): Point {
  const cos = Math.cos(outer.theta);
  const sin = Math.sin(outer.theta);
  return { x: outer.x + cos * inner.x - sin * inner.y, y: outer.y + sin * inner.x + cos * inner.y };
}

/** Where the field's origin is, seen from @p pose. */
export function inverse(pose: Pose): Pose {
  const cos = Math.cos(pose.theta);
  const sin = Math.sin(pose.theta);
  return { x: -cos * pose.x - sin * pose.y, y: sin * pose.x - cos * pose.y, theta: wrap(-pose.theta) };
}

export function polar(pose: Pose, range: number, bearing: number): Point {
  return { x: pose.x + range * Math.cos(pose.theta + bearing), y: pose.y + range * Math.sin(pose.theta + bearing) };
}

export interface Ellipse {
  /** Half axes of one sigma [m], the longer one first. */
  major: number;
  minor: number;
  /** Of the longer axis [rad]. */
  angle: number;
}

/** The ellipse of a covariance [[xx, xy], [xy, yy]]. */
export function ellipseOf(xx: number, xy: number, yy: number): Ellipse {
  const mean = (xx + yy) / 2;
  const spread = Math.hypot((xx - yy) / 2, xy);
  return {
    major: Math.sqrt(Math.max(0, mean + spread)),
    minor: Math.sqrt(Math.max(0, mean - spread)),
    angle: 0.5 * Math.atan2(2 * xy, xx - yy),
  };
}

export const degrees = (angle: number): number => (angle * 180) / Math.PI;
export const radians = (angle: number): number => (angle * Math.PI) / 180;
