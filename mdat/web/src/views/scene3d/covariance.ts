// The covariance of the position as an ellipsoid at the estimate, made larger by a number that the legend says; weak directions as lines.
import {
  BufferAttribute,
  BufferGeometry,
  Color,
  DoubleSide,
  Group,
  LineBasicMaterial,
  LineSegments,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  SphereGeometry,
  Vector3,
  WireframeGeometry,
} from "three";
import type { FrameInfo, WeakDirection } from "../../api/types.ts";
import { cssValue } from "../../app/theme.ts";
import { block3, symmetricAxes } from "../../maths/eigen.ts";
import { niceBelow, shortNumber, withUnit } from "../../maths/scales.ts";

const SIGMAS = 3;
/** Share of the target's size that the longest half axis shall have on the screen, at most. */
const SHARE = 0.3;

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

/** A weak direction in words: what it moves, and by how much. */
export function weakNote(weak: WeakDirection, index: number): string {
  const turn = Math.hypot(...weak.direction.slice(3));
  const shift = Math.hypot(...weak.direction.slice(0, 3));
  const axis = (turn > shift ? weak.direction.slice(3) : weak.direction.slice(0, 3)).map((x) => shortNumber(x, 2)).join(", ");
  const sigma = turn > shift ? withUnit((weak.sigma * 180) / Math.PI, "°") : withUnit(1000 * weak.sigma, "mm");
  return `Weak ${index + 1}: ${turn > shift ? "turn about" : "shift along"} (${axis}), sigma ${sigma}`;
}

export class Covariance {
  readonly group = new Group();
  private readonly skin = new MeshBasicMaterial({ transparent: true, opacity: 0.22, depthWrite: false, side: DoubleSide });
  private readonly lines = new LineBasicMaterial({ transparent: true, opacity: 0.8, depthTest: false });
  private readonly weakLines = new LineSegments(new BufferGeometry(), new LineBasicMaterial({ depthTest: false }));
  private readonly body = new Group();

  constructor() {
    const sphere = new SphereGeometry(1, 24, 16);
    const net = new LineSegments(new WireframeGeometry(new SphereGeometry(1, 12, 8)), this.lines);
    this.body.add(new Mesh(sphere, this.skin), net);
    this.body.matrixAutoUpdate = false;
    this.body.renderOrder = 2;
    this.weakLines.renderOrder = 3;
    this.weakLines.frustumCulled = false;
    this.group.add(this.body, this.weakLines);
    this.applyTheme();
  }

  applyTheme(): void {
    this.skin.color = new Color(cssValue("--ellipsoid"));
    this.lines.color = new Color(cssValue("--ellipsoid"));
    this.weakLines.material.color = new Color(cssValue("--weak"));
  }

  /** Shows the frame's covariance; returns what the legend shall say of it. */
  show(frame: FrameInfo, size_m: number, wanted: boolean): string[] {
    const pose = frame.poses.estimate;
    const ellipsoid = ellipsoidOf(frame.covariance, size_m);
    this.group.visible = wanted && pose !== null && ellipsoid !== null;
    if (pose === null || ellipsoid === null || !wanted) return [];
    const [x, y, z] = ellipsoid.halfAxes.map((axis) => new Vector3(...axis.direction).multiplyScalar(Math.max(axis.length_m, 1e-6)));
    this.body.matrix.copy(new Matrix4().makeBasis(x, y, z).setPosition(...pose.position_m));
    this.body.matrixWorldNeedsUpdate = true;
    this.showWeak(frame.weak, pose.position_m, size_m);
    const sigmas = ellipsoid.sigma_mm.map((sigma) => shortNumber(sigma)).join(", ");
    return [`Ellipsoid: ${SIGMAS} sigma, × ${shortNumber(ellipsoid.magnification)}`, `Sigma ${sigmas} mm`, ...frame.weak.map(weakNote)];
  }

  /** Each weak direction as a line through the estimate, along the shift or the axis of the turn. */
  private showWeak(weak: WeakDirection[], at: [number, number, number], size_m: number): void {
    const places = weak.flatMap(({ direction }) => {
      const shift = new Vector3(...(direction.slice(0, 3) as [number, number, number]));
      const turn = new Vector3(...(direction.slice(3) as [number, number, number]));
      const along = (shift.length() > turn.length() ? shift : turn).setLength(0.6 * size_m);
      const centre = new Vector3(...at);
      return [...centre.clone().sub(along).toArray(), ...centre.clone().add(along).toArray()];
    });
    this.weakLines.geometry.dispose();
    this.weakLines.geometry = new BufferGeometry();
    this.weakLines.geometry.setAttribute("position", new BufferAttribute(Float32Array.from(places), 3));
  }
}
