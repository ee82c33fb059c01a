// The pointer in the 3D view: says what the point under it is, and takes points while measuring.
import type { Signal } from "@preact/signals";
import { Raycaster, Vector2 } from "three";
import type { Scan } from "../../api/decode.ts";
import type { FrameInfo } from "../../api/types.ts";
import { remark } from "../../app/notices.ts";
import type { Session } from "../../app/session.ts";
import { withUnit } from "../../maths/scales.ts";
import type { Vec3 } from "../../maths/vectors.ts";
import type { Cloud } from "./cloud.ts";
import { STATES } from "./colours.ts";
import type { Measuring } from "./measuring.ts";
import type { SceneReport } from "./scene.ts";
import type { Stage } from "./stage.ts";
import type { Target } from "./target.ts";

const NEAR_PX = 12;
const CLICK_PX = 4;

export class Pointing {
  private readonly ends: (() => void)[] = [];
  private down: [number, number] | null = null;
  private scan: Scan | null = null;
  private frame: FrameInfo | null = null;

  constructor(
    private readonly stage: Stage,
    private readonly cloud: Cloud,
    private readonly target: Target,
    private readonly measuring: Measuring,
    private readonly session: Session,
    private readonly report: Signal<SceneReport | null>,
  ) {
    this.listen("pointermove", (event) => this.hover(...this.placeOf(event)));
    this.listen("pointerleave", () => this.say(-1));
    this.listen("pointerdown", (event) => {
      this.down = event.button === 0 ? [event.clientX, event.clientY] : null;
    });
    this.listen("pointerup", (event) => {
      const still = this.down !== null && Math.hypot(event.clientX - this.down[0], event.clientY - this.down[1]) <= CLICK_PX;
      this.down = null;
      if (still && session.scene.measuring.peek()) this.pickAt(...this.placeOf(event), NEAR_PX);
    });
  }

  setFrame(frame: FrameInfo, scan: Scan): void {
    this.frame = frame;
    this.scan = scan;
  }

  /** Takes the scan's point near a place of the view while measuring, else the surface there. */
  pickAt(x_px: number, y_px: number, within_px: number): void {
    if (!this.session.scene.measuring.peek()) return;
    const row = this.nearest(x_px, y_px, within_px);
    const point = row >= 0 ? this.cloud.placeOf(row) : this.onSurface(x_px, y_px);
    if (point === null) remark("There is no point here: choose one of the scan, or one on the target.");
    else this.measuring.take(point);
  }

  destroy(): void {
    for (const end of this.ends) end();
  }

  private listen(name: "pointermove" | "pointerleave" | "pointerdown" | "pointerup", act: (event: PointerEvent) => void): void {
    const element = this.stage.renderer.domElement;
    element.addEventListener(name, act);
    this.ends.push(() => element.removeEventListener(name, act));
  }

  private placeOf(event: PointerEvent): [number, number] {
    const place = this.stage.renderer.domElement.getBoundingClientRect();
    return [event.clientX - place.left, event.clientY - place.top];
  }

  private nearest(x_px: number, y_px: number, within_px: number): number {
    const { width, height, camera, sensorFrame } = this.stage;
    return this.cloud.nearest(x_px, y_px, width, height, camera, sensorFrame.matrixWorld, within_px);
  }

  private hover(x_px: number, y_px: number): void {
    if (this.down !== null) return;
    this.say(this.nearest(x_px, y_px, NEAR_PX));
  }

  private say(row: number): void {
    this.session.selection.hoveredPoint.value = row < 0 ? null : row;
    this.report.value = { pointText: row < 0 || this.scan === null ? "" : pointText(this.scan, row) };
  }

  /** Where the line of sight meets the target's surface at the estimate, in the sensor's frame. */
  private onSurface(x_px: number, y_px: number): Vec3 | null {
    const { camera, width, height, sensorFrame } = this.stage;
    if (this.frame?.poses.estimate == null) return null;
    const ray = new Raycaster();
    ray.setFromCamera(new Vector2((2 * x_px) / width - 1, 1 - (2 * y_px) / height), camera);
    const [hit] = ray.intersectObjects(this.target.surfaces, false);
    return hit === undefined ? null : (sensorFrame.worldToLocal(hit.point).toArray() as Vec3);
  }
}

/** All that is known of one ray. */
export function pointText(scan: Scan, row: number): string {
  const { residual_m, sigma_m, range_m, age_s, state } = scan.columns;
  const facts = [
    `Ray ${row}: ${STATES[state[row]] ?? `state ${state[row]}`}`,
    `range ${withUnit(range_m[row], "m", 4)}`,
    `residual ${withUnit(1000 * residual_m[row], "mm")}`,
    `sigma ${withUnit(1000 * sigma_m[row], "mm")}`,
    `age ${withUnit(1000 * age_s[row], "ms")}`,
  ];
  return facts.filter((fact) => !fact.endsWith("–")).join(", ");
}
