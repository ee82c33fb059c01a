// Words in the 3D view: elements of the page that follow places of the sensor's frame.
import { Vector3 } from "three";
import type { Vec3 } from "../../maths/vectors.ts";
import type { Stage } from "./stage.ts";

interface Label {
  element: HTMLElement;
  place: Vec3;
}

export class Labels {
  private labels: Label[] = [];
  private readonly layer = document.createElement("div");
  private readonly stage: Stage;

  constructor(stage: Stage, box: HTMLElement) {
    this.stage = stage;
    this.layer.className = "labels";
    this.layer.setAttribute("aria-hidden", "true");
    box.append(this.layer);
    stage.beforeDrawing.push(() => this.move());
  }

  /** Replaces all labels. */
  set(labels: { text: string; place: Vec3; kind: string }[]): void {
    this.labels = labels.map(({ text, place, kind }) => {
      const element = document.createElement("span");
      element.className = `label label-${kind}`;
      element.textContent = text;
      return { element, place };
    });
    this.layer.replaceChildren(...this.labels.map((label) => label.element));
    this.stage.invalidate();
  }

  private move(): void {
    const { camera, sensorFrame, width, height } = this.stage;
    const place = new Vector3();
    camera.updateMatrixWorld();
    sensorFrame.updateMatrixWorld();
    for (const label of this.labels) {
      place
        .set(...label.place)
        .applyMatrix4(sensorFrame.matrixWorld)
        .project(camera);
      label.element.hidden = place.z > 1 || Math.abs(place.x) > 1 || Math.abs(place.y) > 1;
      label.element.style.transform = `translate(${((place.x + 1) / 2) * width}px, ${((1 - place.y) / 2) * height}px)`;
    }
  }
}
