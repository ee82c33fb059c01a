// The four cameras. Camera and controls stay in coordinates of a rig; the content is moved against it, so that turning works alike in all.
import { MathUtils, Matrix4, Quaternion, Vector3 } from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import type { CameraInfo, PoseData } from "../../api/types.ts";
import type { CameraName } from "./choice.ts";
import type { Stage } from "./stage.ts";

const FIELD_DEG = 40;
const TURN_RAD = MathUtils.degToRad(7.5);
const NEARER = 0.85;

export function matrixOf(pose: PoseData): Matrix4 {
  return new Matrix4().compose(new Vector3(...pose.position_m), new Quaternion(...pose.quaternion_xyzw), new Vector3(1, 1, 1));
}

export class Cameras {
  private readonly stage: Stage;
  private readonly controls: OrbitControls;
  private readonly eye: CameraInfo | null;
  private size_m: number;
  private name: CameraName = "free";
  private target = new Matrix4().makeTranslation(0, 0, 3);
  private rig = new Matrix4();
  private placed = false;

  constructor(stage: Stage, eye: CameraInfo | null, size_m: number) {
    this.stage = stage;
    this.eye = eye;
    this.size_m = size_m > 0 ? size_m : 1;
    this.controls = new OrbitControls(stage.camera, stage.renderer.domElement);
    this.controls.addEventListener("change", stage.invalidate);
  }

  /** Where the target is now, in the sensor's frame. */
  setTarget(pose: PoseData): void {
    this.target = matrixOf(pose);
    this.moveRig();
    if (!this.placed) this.fit();
    this.placed = true;
  }

  /** Another size than was known, and the target into the view by it. */
  setSize(size_m: number): void {
    this.size_m = size_m;
    this.fit();
  }

  choose(name: CameraName): void {
    if (this.name === name) return;
    const fromEye = this.name === "eye";
    this.name = name;
    this.controls.enabled = name !== "eye";
    const inSensor = this.stage.camera.position.clone().applyMatrix4(this.rig);
    const lookedAt = this.controls.target.clone().applyMatrix4(this.rig);
    this.moveRig();
    const back = this.rig.clone().invert();
    this.stage.camera.position.copy(inSensor.applyMatrix4(back));
    this.controls.target.copy(lookedAt.applyMatrix4(back));
    if (name === "eye") this.lookThroughSensor();
    else if (fromEye || name === "chase") this.fit();
    else this.controls.update();
    this.stage.invalidate();
  }

  /** Puts the target into the view, from behind and beside the sensor's line of sight. */
  fit(): void {
    if (this.name === "eye") return;
    const { camera } = this.stage;
    const centre = new Vector3().setFromMatrixPosition(this.target).applyMatrix4(this.rig.clone().invert());
    const distance = (0.54 * this.size_m) / Math.tan(MathUtils.degToRad(FIELD_DEG / 2)) / Math.min(1, camera.aspect);
    const from = this.name === "chase" ? new Vector3(-0.55, -0.5, -1) : new Vector3(-0.75, -0.42, -1);
    camera.fov = FIELD_DEG;
    camera.position.copy(centre).addScaledVector(from.normalize(), distance);
    this.setDepth(distance);
    this.controls.target.copy(centre);
    this.controls.update();
    this.stage.invalidate();
  }

  /** Turns about the looked-at point: quarter turns of the keys. */
  turn(right: number, down: number): void {
    if (this.name === "eye") return;
    const { camera } = this.stage;
    const arm = camera.position.clone().sub(this.controls.target);
    const radius = arm.length();
    const side = new Vector3().crossVectors(camera.up, arm).normalize();
    arm.applyAxisAngle(camera.up, right * TURN_RAD);
    const height = arm.angleTo(camera.up);
    const tilt = MathUtils.clamp(height - down * TURN_RAD, 0.05, Math.PI - 0.05) - height;
    arm.applyAxisAngle(side.applyAxisAngle(camera.up, right * TURN_RAD), tilt);
    camera.position.copy(this.controls.target).add(arm.setLength(radius));
    this.controls.update();
    this.stage.invalidate();
  }

  approach(nearer: boolean): void {
    if (this.name === "eye") return;
    const { camera } = this.stage;
    const arm = camera.position.clone().sub(this.controls.target);
    camera.position.copy(this.controls.target).addScaledVector(arm, nearer ? NEARER : 1 / NEARER);
    this.controls.update();
    this.stage.invalidate();
  }

  destroy(): void {
    this.controls.dispose();
  }

  private moveRig(): void {
    this.rig = new Matrix4();
    if (this.name === "target") this.rig.copyPosition(this.target);
    if (this.name === "chase") this.rig.copy(this.target);
    this.stage.sensorFrame.matrix.copy(this.rig).invert();
    this.stage.sensorFrame.matrixWorldNeedsUpdate = true;
    this.stage.invalidate();
  }

  private lookThroughSensor(): void {
    const { camera } = this.stage;
    const [across, down] = this.eye?.frustum_deg ?? [FIELD_DEG, FIELD_DEG];
    const forWidth = 2 * Math.atan(Math.tan(MathUtils.degToRad(across / 2)) / camera.aspect);
    camera.fov = 1.08 * Math.max(down, MathUtils.radToDeg(forWidth));
    camera.position.set(0, 0, 0);
    camera.lookAt(0, 0, 1);
    this.setDepth(this.eye?.range_m[1] ?? 100);
  }

  private setDepth(distance: number): void {
    const { camera } = this.stage;
    camera.near = Math.min(0.05, distance / 500);
    camera.far = Math.max(10 * distance, 5 * (this.eye?.range_m[1] ?? 10));
    camera.updateProjectionMatrix();
  }
}
