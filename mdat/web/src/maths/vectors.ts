// Small vectors and rotations. Quaternions are Hamilton, scalar last.

export type Vec3 = [number, number, number];
export type Quaternion = [number, number, number, number];

export const add = (a: Vec3, b: Vec3): Vec3 => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const subtract = (a: Vec3, b: Vec3): Vec3 => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const dot = (a: Vec3, b: Vec3): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const norm = (a: Vec3): number => Math.sqrt(dot(a, a));
export const cross = (a: Vec3, b: Vec3): Vec3 => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

export const conjugate = (q: Quaternion): Quaternion => [-q[0], -q[1], -q[2], q[3]];

export function multiply(a: Quaternion, b: Quaternion): Quaternion {
  const v = add(add(scale([b[0], b[1], b[2]], a[3]), scale([a[0], a[1], a[2]], b[3])), cross([a[0], a[1], a[2]], [b[0], b[1], b[2]]));
  return [...v, a[3] * b[3] - dot([a[0], a[1], a[2]], [b[0], b[1], b[2]])];
}

export function scale(a: Vec3, s: number): Vec3 {
  return [a[0] * s, a[1] * s, a[2] * s];
}

/** Angle of the rotation between two attitudes, 0 to 180. */
export function angleBetween_deg(a: Quaternion, b: Quaternion): number {
  const [x, y, z, w] = multiply(conjugate(a), b);
  return (2 * Math.atan2(norm([x, y, z]), Math.abs(w)) * 180) / Math.PI;
}
