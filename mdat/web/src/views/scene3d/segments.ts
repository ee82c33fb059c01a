// Places of lines in the sensor's frame, three numbers each, without anything of three.js.
import type { Scan } from "../../api/decode.ts";
import type { CameraInfo } from "../../api/types.ts";
import { MISS, RETURN } from "./colours.ts";

/** Share of a missed ray that is drawn: its end about the target. */
const DRAWN_FROM = 0.93;
const DRAWN_TO = 1.07;

/** The stretch of each missed ray where it passes the target: six numbers a ray. */
export function missedSegments(scan: Scan): number[] {
  const { x, y, z, state } = scan.columns;
  const places: number[] = [];
  for (let i = 0; i < scan.count; ++i) {
    if (state[i] !== MISS || !Number.isFinite(x[i])) continue;
    for (const share of [DRAWN_FROM, DRAWN_TO]) places.push(share * x[i], share * y[i], share * z[i]);
  }
  return places;
}

/** Where each missed ray passes the target. */
export function passedPlaces(scan: Scan): number[] {
  const { x, y, z, state } = scan.columns;
  const places: number[] = [];
  for (let i = 0; i < scan.count; ++i) if (state[i] === MISS && Number.isFinite(x[i])) places.push(x[i], y[i], z[i]);
  return places;
}

/** The middle of the returns, and the diameter of a sphere that holds most of them: where to look when no pose is known; null without returns. */
export function extentOf(scan: Scan): { middle: [number, number, number]; size_m: number } | null {
  const { x, y, z, state } = scan.columns;
  const rows = Array.from({ length: scan.count }, (_, i) => i).filter((i) => state[i] === RETURN && Number.isFinite(x[i]));
  if (rows.length === 0) return null;
  const mean = (column: Float32Array) => rows.reduce((sum, i) => sum + column[i], 0) / rows.length;
  const middle: [number, number, number] = [mean(x), mean(y), mean(z)];
  const squares = rows.reduce((sum, i) => sum + (x[i] - middle[0]) ** 2 + (y[i] - middle[1]) ** 2 + (z[i] - middle[2]) ** 2, 0);
  return { middle, size_m: 4 * Math.sqrt(squares / rows.length) };
}

/** The rays' directions in the order of the scan, at one distance. */
export function patternPlaces(scan: Scan, distance_m: number): number[] {
  const { x, y, z } = scan.columns;
  const places: number[] = [];
  for (let i = 0; i < scan.count; ++i) {
    const range = Math.hypot(x[i], y[i], z[i]);
    if (range > 0) places.push((x[i] / range) * distance_m, (y[i] / range) * distance_m, (z[i] / range) * distance_m);
  }
  return places;
}

/** Edges of the field of view from its nearest to its farthest range: pairs of places. */
export function frustumSegments(camera: CameraInfo, to_m: number): number[] {
  const [right, down] = camera.frustum_deg.map((full) => Math.tan((full * Math.PI) / 360));
  const corner = (i: number, z: number) => [(i === 0 || i === 3 ? -1 : 1) * right * z, (i < 2 ? -1 : 1) * down * z, z];
  const near = Math.min(camera.range_m[0], to_m);
  const places: number[] = [];
  for (let i = 0; i < 4; ++i) {
    const next = (i + 1) % 4;
    places.push(0, 0, 0, ...corner(i, to_m), ...corner(i, near), ...corner(next, near), ...corner(i, to_m), ...corner(next, to_m));
  }
  return places;
}
