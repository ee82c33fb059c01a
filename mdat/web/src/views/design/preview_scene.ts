// Draws a preview: the target, the field of view, the pattern and where its rays end, by the parts of the replay's 3D view.
import { effect } from "@preact/signals";
import { AxesHelper, Color, Group, SRGBColorSpace } from "three";
import { tell } from "../../app/notices.ts";
import { cssValue, theme } from "../../app/theme.ts";
import { type Preview, type PreviewAnswer, scanOf } from "../../design/preview.ts";
import { norm, subtract } from "../../maths/vectors.ts";
import { textScale } from "../../parts/rem.ts";
import { Cameras, matrixOf } from "../scene3d/cameras.ts";
import { Cloud } from "../scene3d/cloud.ts";
import { Lines } from "../scene3d/lines.ts";
import { Stage } from "../scene3d/stage.ts";
import { Target } from "../scene3d/target.ts";

const LAYERS = { estimate: true, truth: false, filtered: false };
/** How far the target moves, in its sizes, before the view is laid anew. */
const MOVED = 0.5;

/** The surface with the group that it is drawn in: another one takes its place. */
interface Surface {
  digest: string;
  group: Group;
  target: Target;
}

class PreviewScene {
  private readonly stage: Stage;
  private readonly cameras: Cameras;
  private readonly cloud: Cloud;
  private readonly lines = new Lines();
  /** Of the sensor that scans. */
  private readonly ownFrame = new Group();
  private readonly preview: Preview;
  private surface: Surface | null = null;
  private loading = "";
  private size_m = 0;
  private place: number[] = [];
  private readonly ends: (() => void)[];

  constructor(box: HTMLElement, preview: Preview) {
    this.preview = preview;
    this.stage = new Stage(box);
    this.cameras = new Cameras(this.stage, null, 1);
    this.cloud = new Cloud(this.stage.renderer.getPixelRatio() * textScale());
    this.ownFrame.matrixAutoUpdate = false;
    this.ownFrame.add(this.cloud.points, this.lines.group, new AxesHelper(0.1));
    this.stage.sensorFrame.add(this.ownFrame, new AxesHelper(0.05));
    this.ends = [effect(() => this.show(preview.shown.value)), effect(() => this.applyTheme(theme.value))];
  }

  destroy(): void {
    for (const end of this.ends) end();
    this.cameras.destroy();
    this.stage.destroy();
  }

  /** What a key does; false: nothing. */
  press(key: string): boolean {
    const turns: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    if (turns[key] !== undefined) this.cameras.turn(...turns[key]);
    else if (key === "PageUp" || key === "PageDown") this.cameras.approach(key === "PageUp");
    else if (key === "f") this.cameras.fit();
    else return false;
    return true;
  }

  fit(): void {
    this.cameras.fit();
  }

  private applyTheme(_: string): void {
    this.lines.applyTheme();
    this.surface?.target.applyTheme();
    this.show(this.preview.shown.peek());
    this.stage.applyTheme();
  }

  private show(answer: PreviewAnswer | null): void {
    if (answer === null) return;
    const scan = scanOf(answer);
    const { r, g, b } = new Color(cssValue("--accent")).getRGB(new Color(), SRGBColorSpace);
    const distance_m = norm(subtract(answer.pose.position_m, answer.own.position_m));
    this.ownFrame.matrix.copy(matrixOf(answer.own));
    this.ownFrame.matrixWorldNeedsUpdate = true;
    this.cloud.show(
      scan,
      Float32Array.from({ length: 3 * scan.count }, (_, i) => [r, g, b][i % 3]),
      false,
    );
    this.lines.showScan(scan, distance_m);
    this.lines.showFrustum(answer.camera, distance_m, answer.size_m);
    this.lines.missed.visible = false;
    this.surface?.target.show({ poses: { estimate: answer.pose, filtered: null, truth: null } }, LAYERS);
    if (this.surface?.digest !== answer.surface) this.load(answer.surface).catch((error) => this.failed(answer.surface, error));
    this.look(answer);
    this.stage.renderer.domElement.dataset.rays = String(scan.count);
    this.stage.renderer.domElement.dataset.place = answer.own.position_m.map((x) => Number(x.toFixed(4))).join(" ");
    this.stage.invalidate();
  }

  /** The camera stays, unless the target is another one or elsewhere. */
  private look({ pose, size_m }: PreviewAnswer): void {
    const moved_m = Math.hypot(...pose.position_m.map((x, i) => x - (this.place[i] ?? 0)));
    this.cameras.setTarget(pose);
    if (size_m === this.size_m && moved_m < MOVED * size_m) return;
    this.size_m = size_m;
    this.place = pose.position_m;
    this.cameras.setSize(size_m);
  }

  /** The next answer asks again. */
  private failed(digest: string, error: unknown): void {
    if (this.loading === digest) this.loading = "";
    tell(error);
  }

  private async load(digest: string): Promise<void> {
    if (this.loading === digest) return;
    this.loading = digest;
    const address = URL.createObjectURL(new Blob([await this.preview.surface()]));
    const group = new Group();
    const target = new Target(group);
    await target.load(address).finally(() => URL.revokeObjectURL(address));
    const shown = this.preview.shown.peek();
    if (this.loading !== digest || shown === null) return;
    this.loading = "";
    if (this.surface !== null) this.stage.sensorFrame.remove(this.surface.group);
    this.stage.sensorFrame.add(group);
    this.surface = { digest, group, target };
    this.stage.renderer.domElement.dataset.surface = digest;
    this.show(shown);
  }
}

export interface PreviewView {
  destroy(): void;
  press(key: string): boolean;
  fit(): void;
}

/** Begins to draw in a box. */
export function startPreview(box: HTMLElement, preview: Preview): PreviewView {
  return new PreviewScene(box, preview);
}
