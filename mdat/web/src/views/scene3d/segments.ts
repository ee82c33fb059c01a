// Places of lines in the sensor's frame, three numbers each, without anything of three.js.
import type { Scan } from "../../api/decode.ts";
import type { CameraInfo } from "../../api/types.ts";
import { MISS } from "./colours.ts";

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
