// The scan's points, round and of a size on the screen; and the search for the one under the pointer.
import { BufferAttribute, BufferGeometry, type Camera, type Matrix4, Points, ShaderMaterial, Vector3 } from "three";
import type { Scan } from "../../api/decode.ts";
import { MISS, RETURN } from "./colours.ts";

const SIZE_PX = 5.5;

const VERTEX = `
attribute vec3 colour;
uniform float size;
varying vec3 shade;
void main() {
  shade = colour;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  gl_PointSize = size;
}`;

// A round point with a dark rim, so that each is seen on any ground.
const FRAGMENT = `
varying vec3 shade;
void main() {
  float r = 2.0 * length(gl_PointCoord - 0.5);
  if (r > 1.0) discard;
  gl_FragColor = vec4(r > 0.74 ? shade * 0.45 : shade, 1.0);
}`;

/** Which rows are points: returns, and those others that are drawn by their state. */
function drawnRows(scan: Scan, alsoMissed: boolean): number[] {
  const { state, x } = scan.columns;
  const rows: number[] = [];
  for (let i = 0; i < scan.count; ++i) if (Number.isFinite(x[i]) && (state[i] === RETURN || (alsoMissed && state[i] >= MISS))) rows.push(i);
  return rows;
}

export class Cloud {
  readonly points: Points<BufferGeometry, ShaderMaterial>;
  private rows: number[] = [];
  private scan: Scan | null = null;

  constructor(density: number) {
    const material = new ShaderMaterial({
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      uniforms: { size: { value: SIZE_PX * density } },
    });
    this.points = new Points(new BufferGeometry(), material);
    this.points.frustumCulled = false;
  }

  show(scan: Scan, colours: Float32Array, alsoMissed: boolean): void {
    const { x, y, z } = scan.columns;
    this.scan = scan;
    this.rows = drawnRows(scan, alsoMissed);
    const place = new Float32Array(3 * this.rows.length);
    const colour = new Float32Array(3 * this.rows.length);
    this.rows.forEach((row, i) => {
      place.set([x[row], y[row], z[row]], 3 * i);
      colour.set(colours.subarray(3 * row, 3 * row + 3), 3 * i);
    });
    this.points.geometry.dispose();
    this.points.geometry = new BufferGeometry();
    this.points.geometry.setAttribute("position", new BufferAttribute(place, 3));
    this.points.geometry.setAttribute("colour", new BufferAttribute(colour, 3));
  }

  /** The row nearest to a place of the view (pixels), within `within_px`; -1 where there is none. */
  nearest(x_px: number, y_px: number, width: number, height: number, camera: Camera, sensorFrame: Matrix4, within_px: number): number {
    if (this.scan === null) return -1;
    const { x, y, z } = this.scan.columns;
    const place = new Vector3();
    let best = within_px;
    let found = -1;
    for (const row of this.rows) {
      place.set(x[row], y[row], z[row]).applyMatrix4(sensorFrame).project(camera);
      if (place.z > 1) continue;
      const distance = Math.hypot(((place.x + 1) / 2) * width - x_px, ((1 - place.y) / 2) * height - y_px);
      if (distance < best) {
        best = distance;
        found = row;
      }
    }
    return found;
  }

  placeOf(row: number): [number, number, number] {
    const { x, y, z } = this.scan!.columns;
    return [x[row], y[row], z[row]];
  }
}
