// What the 3D view shows, and how. The view itself is loaded later; keys and buttons speak to this.
import { type Signal, signal } from "@preact/signals";
import type { RecordingInfo } from "../../api/types.ts";
import type { Vec3 } from "../../maths/vectors.ts";

export type CameraName = "free" | "eye" | "target" | "chase";
export const CAMERAS: readonly { id: CameraName; label: string; help: string }[] = [
  { id: "free", label: "Free", help: "The camera stays where you put it" },
  { id: "eye", label: "Sensor's eye", help: "What the sensor sees, through its field of view" },
  { id: "target", label: "Target", help: "The camera goes with the target's position" },
  { id: "chase", label: "Chase", help: "The camera goes with the target's position and attitude" },
];

export type ColourName = "residual" | "range" | "sigma" | "age" | "state" | "part";
export const COLOURS: readonly { id: ColourName; label: string }[] = [
  { id: "residual", label: "Residual" },
  { id: "range", label: "Range" },
  { id: "sigma", label: "Sigma" },
  { id: "age", label: "Age" },
  { id: "state", label: "State" },
  { id: "part", label: "Part" },
];

export type LayerName = "estimate" | "truth" | "filtered" | "points" | "missed" | "frustum" | "pattern" | "covariance";
export const LAYERS: readonly { id: LayerName; label: string; preset: boolean }[] = [
  { id: "estimate", label: "Target at the estimate", preset: true },
  { id: "truth", label: "Target at the truth", preset: true },
  { id: "filtered", label: "Target at the filter's pose", preset: false },
  { id: "points", label: "Points", preset: true },
  { id: "missed", label: "Rays that missed", preset: true },
  { id: "frustum", label: "Field of view", preset: true },
  { id: "pattern", label: "Scan pattern", preset: false },
  { id: "covariance", label: "Covariance", preset: true },
];

export type Request = "fit" | "pick" | "left" | "right" | "up" | "down" | "nearer" | "farther" | "picture";

/** Two points in the sensor's frame. */
export interface Measurement {
  a: Vec3;
  b: Vec3;
}

export class SceneChoice {
  readonly camera: Signal<CameraName> = signal("target");
  readonly colour: Signal<ColourName> = signal("residual");
  readonly layers: Signal<Record<LayerName, boolean>>;
  readonly measuring: Signal<boolean> = signal(false);
  readonly firstPoint: Signal<Vec3 | null> = signal(null);
  readonly measurements: Signal<Measurement[]> = signal([]);
  /** Asks the view to do something once; the number makes two equal requests differ. */
  readonly request: Signal<{ what: Request; count: number } | null> = signal(null);

  constructor(info: RecordingInfo) {
    const layers = Object.fromEntries(LAYERS.map((layer) => [layer.id, layer.preset])) as Record<LayerName, boolean>;
    this.layers = signal({ ...layers, truth: layers.truth && info.has_truth });
  }

  ask(what: Request): void {
    this.request.value = { what, count: (this.request.peek()?.count ?? 0) + 1 };
  }

  toggle(layer: LayerName): void {
    const layers = this.layers.peek();
    this.layers.value = { ...layers, [layer]: !layers[layer] };
  }

  toggleMeasuring(): void {
    this.firstPoint.value = null;
    this.measuring.value = !this.measuring.peek();
  }
}
