// Measuring: lines between chosen points, with their length beside them. A measurement can be undone.
import { BufferAttribute, BufferGeometry, Color, LineBasicMaterial, LineSegments, Points, PointsMaterial } from "three";
import { setting } from "../../app/history.ts";
import type { Session } from "../../app/session.ts";
import { cssValue } from "../../app/theme.ts";
import { lengthText } from "../../maths/scales.ts";
import { add, norm, scale, subtract, type Vec3 } from "../../maths/vectors.ts";
import type { Measurement } from "./choice.ts";
import type { Labels } from "./labels.ts";
import type { Stage } from "./stage.ts";

export class Measuring {
  private readonly lines = new LineSegments(new BufferGeometry(), new LineBasicMaterial({ depthTest: false }));
  private readonly ends: Points<BufferGeometry, PointsMaterial>;
  private readonly stage: Stage;
  private readonly labels: Labels;
  private readonly session: Session;

  constructor(stage: Stage, labels: Labels, session: Session) {
    this.stage = stage;
    this.labels = labels;
    this.session = session;
    const size = 9 * stage.renderer.getPixelRatio();
    this.ends = new Points(new BufferGeometry(), new PointsMaterial({ size, sizeAttenuation: false, depthTest: false }));
    for (const object of [this.lines, this.ends]) {
      object.frustumCulled = false;
      object.renderOrder = 5;
      stage.sensorFrame.add(object);
    }
    this.applyTheme();
  }

  applyTheme(): void {
    this.lines.material.color = new Color(cssValue("--measure"));
    this.ends.material.color = new Color(cssValue("--measure"));
  }

  /** Takes a point: the first, or the second, which ends the measurement. */
  take(point: Vec3): void {
    const { scene, history } = this.session;
    const first = scene.firstPoint.peek();
    if (first === null) {
      scene.firstPoint.value = point;
      return;
    }
    scene.firstPoint.value = null;
    history.run(setting("a measurement", scene.measurements, [...scene.measurements.peek(), { a: first, b: point }]));
  }

  show(measurements: Measurement[], first: Vec3 | null): void {
    const places = measurements.flatMap(({ a, b }) => [...a, ...b]);
    this.setPlaces(this.lines, places);
    this.setPlaces(this.ends, first === null ? places : [...places, ...first]);
    this.labels.set(
      measurements.map(({ a, b }) => ({ text: lengthText(norm(subtract(b, a))), place: scale(add(a, b), 0.5), kind: "distance" })),
    );
    this.stage.invalidate();
  }

  private setPlaces(object: LineSegments | Points, places: number[]): void {
    object.geometry.dispose();
    object.geometry = new BufferGeometry();
    object.geometry.setAttribute("position", new BufferAttribute(Float32Array.from(places), 3));
    object.visible = places.length > 0;
  }
}
