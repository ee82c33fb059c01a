// The ellipsoid of a covariance, and weak directions in words.
import type { WeakDirection } from "../../api/types.ts";
import { block3, symmetricAxes } from "../../maths/eigen.ts";
import { niceBelow, withUnit } from "../../maths/scales.ts";

export const SIGMAS = 3;
/** Share of the target's size that the longest half axis shall have on the screen, at most. */
const SHARE = 0.16;

export interface Ellipsoid {
  /** Half axes as drawn, metres, with their directions. */
  halfAxes: { length_m: number; direction: [number, number, number] }[];
  magnification: number;
  sigma_mm: number[];
}

/** The ellipsoid of three sigmas, magnified by a round number until it is seen beside the target; null without a covariance. */
export function ellipsoidOf(covariance: number[] | null, size_m: number): Ellipsoid | null {
  if (covariance === null || covariance.length !== 36) return null;
  const axes = symmetricAxes(block3(covariance, 0));
  const sigmas_m = axes.map((axis) => Math.sqrt(Math.max(0, axis.value)));
  if (!(sigmas_m[0] > 0)) return null;
  const magnification = Math.max(1, niceBelow((SHARE * size_m) / (SIGMAS * sigmas_m[0])));
  return {
    halfAxes: axes.map((axis, i) => ({ length_m: SIGMAS * sigmas_m[i] * magnification, direction: axis.vector })),
    magnification,
    sigma_mm: sigmas_m.map((sigma) => 1000 * sigma),
  };
}

/** A weak direction in words: what it moves most, and by how much. A turn is told by what it moves at the model's radius. */
export function weakNote(weak: WeakDirection, index: number): string {
  const shift = weak.direction.slice(0, 3);
  const turn = weak.direction.slice(3);
  const turns = Math.hypot(...turn) > Math.hypot(...shift);
  const axis = (turns ? turn : shift).map((x) => x.toFixed(2).replace("-", "−")).join(", ");
  const sigma = withUnit(1000 * weak.sigma, "mm");
  return `Weak ${index + 1}: ${turns ? "turn about" : "shift along"} (${axis}), sigma ${sigma}${turns ? " at the target's rim" : ""}`;
}
