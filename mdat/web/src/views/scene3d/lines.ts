// Things made of lines in the sensor's frame: rays that missed, the field of view, the scan pattern.
import { BufferAttribute, BufferGeometry, Color, Group, Line, LineBasicMaterial, LineDashedMaterial, LineSegments } from "three";
import type { Scan } from "../../api/decode.ts";
import type { CameraInfo } from "../../api/types.ts";
import { cssValue } from "../../app/theme.ts";
import { MISS } from "./colours.ts";

/** Share of a missed ray that is drawn: its end about the target. */
const DRAWN_FROM = 0.93;
const DRAWN_TO = 1.07;

function geometryOf(places: number[]): BufferGeometry {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(Float32Array.from(places), 3));
  return geometry;
}

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

export class Lines {
  readonly group = new Group();
  readonly missed = new LineSegments(new BufferGeometry(), new LineBasicMaterial({ transparent: true, opacity: 0.75 }));
  readonly frustum = new LineSegments(new BufferGeometry(), new LineBasicMaterial({ transparent: true, opacity: 0.6 }));
  readonly pattern = new Line(new BufferGeometry(), new LineBasicMaterial({ transparent: true, opacity: 0.55 }));
  readonly boresight = new LineSegments(
    new BufferGeometry(),
    new LineDashedMaterial({ dashSize: 0.05, gapSize: 0.05, transparent: true, opacity: 0.5 }),
  );
  private reach_m = 0;

  constructor() {
    this.group.add(this.missed, this.frustum, this.pattern, this.boresight);
    for (const line of [this.missed, this.frustum, this.pattern, this.boresight]) line.frustumCulled = false;
    this.applyTheme();
  }

  applyTheme(): void {
    this.missed.material.color = new Color(cssValue("--missed"));
    this.frustum.material.color = new Color(cssValue("--frustum"));
    this.pattern.material.color = new Color(cssValue("--frustum"));
    this.boresight.material.color = new Color(cssValue("--frustum"));
  }

  showScan(scan: Scan, distance_m: number): void {
    this.missed.geometry.dispose();
    this.missed.geometry = geometryOf(missedSegments(scan));
    this.pattern.geometry.dispose();
    this.pattern.geometry = geometryOf(patternPlaces(scan, distance_m));
  }

  /** The field of view, drawn a little past the target: all of its range would shrink the rest. */
  showFrustum(camera: CameraInfo | null, distance_m: number, size_m: number): void {
    if (camera === null) return;
    const reach_m = Math.min(camera.range_m[1], Math.ceil((distance_m + size_m) * 2) / 2);
    if (reach_m === this.reach_m) return;
    this.reach_m = reach_m;
    this.frustum.geometry.dispose();
    this.frustum.geometry = geometryOf(frustumSegments(camera, reach_m));
    this.boresight.geometry.dispose();
    this.boresight.geometry = geometryOf([0, 0, 0, 0, 0, reach_m]);
    this.boresight.computeLineDistances();
  }
}
