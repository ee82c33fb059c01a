// Eigenvalues and eigenvectors of a symmetric 3x3 matrix by Jacobi's rotations.
import type { Vec3 } from "./vectors.ts";

export interface Axis {
  value: number;
  vector: Vec3;
}

const SWEEPS = 12;
const PAIRS: [number, number][] = [
  [0, 1],
  [0, 2],
  [1, 2],
];

/** Turns the plane (p, q) so that the element there vanishes; a and v are rows of 3. */
function rotate(a: number[][], v: number[][], p: number, q: number): void {
  if (Math.abs(a[p][q]) < Number.MIN_VALUE) return;
  const angle = 0.5 * Math.atan2(2 * a[p][q], a[q][q] - a[p][p]);
  const c = Math.cos(angle);
  const s = Math.sin(angle);
  for (let k = 0; k < 3; ++k) [a[k][p], a[k][q]] = [c * a[k][p] - s * a[k][q], s * a[k][p] + c * a[k][q]];
  for (let k = 0; k < 3; ++k) [a[p][k], a[q][k]] = [c * a[p][k] - s * a[q][k], s * a[p][k] + c * a[q][k]];
  for (let k = 0; k < 3; ++k) [v[k][p], v[k][q]] = [c * v[k][p] - s * v[k][q], s * v[k][p] + c * v[k][q]];
}

/** The three axes, largest eigenvalue first; vectors have length 1 and are right-handed. */
export function symmetricAxes(matrix: number[][]): [Axis, Axis, Axis] {
  const a = matrix.map((row) => [...row]);
  const v = [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ];
  for (let sweep = 0; sweep < SWEEPS; ++sweep) for (const [p, q] of PAIRS) rotate(a, v, p, q);
  const axes = [0, 1, 2].map((i): Axis => ({ value: a[i][i], vector: [v[0][i], v[1][i], v[2][i]] }));
  axes.sort((left, right) => right.value - left.value);
  const [x, y, z] = axes;
  z.vector = [
    x.vector[1] * y.vector[2] - x.vector[2] * y.vector[1],
    x.vector[2] * y.vector[0] - x.vector[0] * y.vector[2],
    x.vector[0] * y.vector[1] - x.vector[1] * y.vector[0],
  ];
  return [x, y, z];
}

/** The 3x3 block of a 6x6 matrix given row by row; first row and column 0 (translation) or 3 (rotation). */
export function block3(covariance: number[], first: 0 | 3): number[][] {
  return [0, 1, 2].map((i) => [0, 1, 2].map((k) => covariance[(first + i) * 6 + first + k]));
}
