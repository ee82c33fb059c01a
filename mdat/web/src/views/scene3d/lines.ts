// Things made of lines in the sensor's frame: rays that missed, the field of view, the scan pattern.
import {
  BufferAttribute,
  BufferGeometry,
  Color,
  Group,
  Line,
  LineBasicMaterial,
  LineDashedMaterial,
  LineSegments,
  Points,
  PointsMaterial,
} from "three";
import type { Scan } from "../../api/decode.ts";
import type { CameraInfo } from "../../api/types.ts";
import { cssValue } from "../../app/theme.ts";
import { frustumSegments, missedSegments, passedPlaces, patternPlaces } from "./segments.ts";

function geometryOf(places: number[]): BufferGeometry {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(Float32Array.from(places), 3));
  return geometry;
}

export class Lines {
  readonly group = new Group();
  readonly missed = new LineSegments(new BufferGeometry(), new LineBasicMaterial({ transparent: true, opacity: 0.45 }));
  /** Where they pass, as dots: seen along the rays the lines are none. */
  readonly passes = new Points(new BufferGeometry(), new PointsMaterial({ size: 2.5, sizeAttenuation: false }));
  readonly frustum = new LineSegments(new BufferGeometry(), new LineBasicMaterial({ transparent: true, opacity: 0.4 }));
  readonly pattern = new Line(new BufferGeometry(), new LineBasicMaterial({ transparent: true, opacity: 0.55 }));
  readonly boresight = new LineSegments(
    new BufferGeometry(),
    new LineDashedMaterial({ dashSize: 0.05, gapSize: 0.05, transparent: true, opacity: 0.5 }),
  );
  private drawnFrustum = "";

  constructor() {
    this.group.add(this.missed, this.passes, this.frustum, this.pattern, this.boresight);
    for (const line of [this.missed, this.passes, this.frustum, this.pattern, this.boresight]) line.frustumCulled = false;
    this.applyTheme();
  }

  applyTheme(): void {
    this.missed.material.color = new Color(cssValue("--missed"));
    this.passes.material.color = new Color(cssValue("--missed"));
    this.frustum.material.color = new Color(cssValue("--frustum"));
    this.pattern.material.color = new Color(cssValue("--frustum"));
    this.boresight.material.color = new Color(cssValue("--frustum"));
  }

  showScan(scan: Scan, distance_m: number): void {
    this.missed.geometry.dispose();
    this.missed.geometry = geometryOf(missedSegments(scan));
    this.passes.geometry.dispose();
    this.passes.geometry = geometryOf(passedPlaces(scan));
    this.pattern.geometry.dispose();
    this.pattern.geometry = geometryOf(patternPlaces(scan, distance_m));
  }

  /** The field of view, drawn a little past the target: all of its range would shrink the rest. */
  showFrustum(camera: CameraInfo | null, distance_m: number, size_m: number): void {
    if (camera === null) return;
    const reach_m = Math.min(camera.range_m[1], Math.ceil((distance_m + size_m) * 2) / 2);
    const drawn = [...camera.frustum_deg, ...camera.range_m, reach_m].join(" ");
    if (drawn === this.drawnFrustum) return;
    this.drawnFrustum = drawn;
    this.frustum.geometry.dispose();
    this.frustum.geometry = geometryOf(frustumSegments(camera, reach_m));
    this.boresight.geometry.dispose();
    this.boresight.geometry = geometryOf([0, 0, 0, 0, 0, reach_m]);
    this.boresight.computeLineDistances();
  }
}
