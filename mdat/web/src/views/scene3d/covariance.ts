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
import { shortNumber } from "../../maths/scales.ts";
import { ellipsoidOf, SIGMAS, weakNote } from "./ellipsoid.ts";

export class Covariance {
  readonly group = new Group();
  private readonly skin = new MeshBasicMaterial({ transparent: true, opacity: 0.22, depthWrite: false, side: DoubleSide });
  private readonly lines = new LineBasicMaterial({ transparent: true, opacity: 0.4, depthTest: false });
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
