// The 3D view: follows the selection and what is chosen to be shown, and draws. Everything that it needs of three.js is loaded with it.
import { effect, type Signal } from "@preact/signals";
import { AxesHelper } from "three";
import type { Scan } from "../../api/decode.ts";
import type { FrameInfo, PoseData } from "../../api/types.ts";
import { tell } from "../../app/notices.ts";
import type { Session } from "../../app/session.ts";
import { theme } from "../../app/theme.ts";
import { norm } from "../../maths/vectors.ts";
import { saveFile } from "../../parts/controls.tsx";
import { textScale } from "../../parts/rem.ts";
import { Cameras } from "./cameras.ts";
import type { Request } from "./choice.ts";
import { Cloud } from "./cloud.ts";
import { type LegendContent, paint } from "./colours.ts";
import { Covariance } from "./covariance.ts";
import { Labels } from "./labels.ts";
import { Latest } from "./latest.ts";
import { Lines } from "./lines.ts";
import { Measuring } from "./measuring.ts";
import { Pointing } from "./pointing.ts";
import { extentOf } from "./segments.ts";
import { Stage } from "./stage.ts";
import { Target } from "./target.ts";

/** What the view says about what the pointer is on. */
export interface SceneReport {
  pointText: string;
}

/** Frames that are asked for before their time while playing. */
const AHEAD = [1, 2];

interface Shown {
  frame: FrameInfo;
  scan: Scan;
}

class SceneRunner {
  readonly stage: Stage;
  readonly cameras: Cameras;
  private readonly target: Target;
  private readonly cloud: Cloud;
  private readonly lines = new Lines();
  private readonly covariance = new Covariance();
  private readonly measuring: Measuring;
  private readonly pointing: Pointing;
  private readonly session: Session;
  private readonly legend: Signal<LegendContent | null>;
  private readonly latest = new Latest<Shown>();
  private shown: Shown | null = null;
  private size_m: number;
  private readonly ends: (() => void)[] = [];

  constructor(box: HTMLElement, session: Session, legend: Signal<LegendContent | null>, report: Signal<SceneReport | null>) {
    const { info } = session.log;
    this.session = session;
    this.size_m = info.size_m ?? 0;
    this.legend = legend;
    this.stage = new Stage(box);
    this.cameras = new Cameras(this.stage, info.camera, info.size_m);
    this.cloud = new Cloud(this.stage.renderer.getPixelRatio() * textScale());
    const { sensorFrame } = this.stage;
    this.target = new Target(sensorFrame);
    sensorFrame.add(this.cloud.points, this.lines.group, this.covariance.group, new AxesHelper(0.15 * (info.size_m || 1)));
    this.measuring = new Measuring(this.stage, new Labels(this.stage, box), session);
    this.pointing = new Pointing(this.stage, this.cloud, this.target, this.measuring, session, report);
    this.follow();
  }

  destroy(): void {
    for (const end of this.ends) end();
    this.pointing.destroy();
    this.cameras.destroy();
    this.stage.destroy();
  }

  private follow(): void {
    const { selection, scene, log } = this.session;
    if (log.modelPath !== null) this.target.load(log.modelPath).then((size_m) => this.loaded(size_m), tell);
    this.ends.push(
      effect(() => this.applyTheme(theme.value)),
      effect(() => this.load(selection.frame.value, selection.iteration.value)),
      effect(() => this.cameras.choose(scene.camera.value)),
      effect(() => this.showAnew(scene.layers.value, scene.colour.value)),
      effect(() => this.measuring.show(scene.measurements.value, scene.firstPoint.value)),
      effect(() => this.answer(scene.request.value?.what ?? null)),
    );
  }

  /** The surface is there: it is drawn, and tells the target's size where the recording does not. */
  private loaded(size_m: number): void {
    if (!(this.size_m > 0) && size_m > 0) {
      this.size_m = size_m;
      this.cameras.setSize(size_m);
      this.showAnew();
    }
    this.stage.invalidate();
  }

  private applyTheme(_: string): void {
    for (const part of [this.target, this.lines, this.covariance, this.measuring]) part.applyTheme();
    this.stage.applyTheme();
  }

  /** Asks for a frame and its scan; while they are on their way the picture stays. */
  private load(index: number, iteration: number | null): void {
    const { log } = this.session;
    if (log.count.peek() === 0) return;
    const both = async (): Promise<Shown> => {
      const [frame, scan] = await Promise.all([log.frame(index), log.scan(index, iteration ?? undefined)]);
      return { frame, scan };
    };
    const take = (shown: Shown) => {
      this.show(shown);
      this.stage.draw();
    };
    this.latest.ask(both, take, tell);
    const { playing, direction } = this.session.player;
    if (playing.peek()) for (const ahead of AHEAD) this.askAhead(index + ahead * direction.peek());
  }

  private askAhead(index: number): void {
    const { log } = this.session;
    if (index < 0 || index >= log.frames) return;
    log.frame(index).catch(() => undefined);
    log.scan(index).catch(() => undefined);
  }

  /** Another choice of what to show, of the same frame. */
  private showAnew(..._chosen: unknown[]): void {
    if (this.shown !== null) this.show(this.shown);
  }

  private show(shown: Shown): void {
    this.shown = shown;
    const { scene, log } = this.session;
    const { frame, scan } = shown;
    const layers = scene.layers.peek();
    const place = frame.poses.estimate ?? frame.poses.filtered ?? frame.poses.truth ?? this.placeOfPoints(scan);
    const distance_m = place === null ? 0 : norm(place.position_m);
    const painted = paint(scan, scene.colour.peek(), log.info.parts ?? [], log.scanless);
    this.cloud.show(scan, painted.colours, scene.colour.peek() === "state");
    this.cloud.points.visible = layers.points;
    this.lines.showScan(scan, distance_m);
    this.lines.showFrustum(log.info.camera, distance_m, this.size_m);
    this.lines.missed.visible = this.lines.passes.visible = layers.missed;
    this.lines.pattern.visible = layers.pattern;
    this.lines.frustum.visible = this.lines.boresight.visible = layers.frustum;
    this.target.show(frame, layers);
    const notes = this.covariance.show(frame, this.size_m || 1, layers.covariance);
    this.legend.value = { ...painted.legend, notes };
    this.pointing.setFrame(frame, scan);
    if (place !== null) this.cameras.setTarget(place);
    this.stage.renderer.domElement.dataset.frame = String(frame.index);
    this.stage.invalidate();
  }

  /** Without any pose the camera looks at the points, and takes its distance from their spread. */
  private placeOfPoints(scan: Scan): PoseData | null {
    const extent = extentOf(scan);
    if (extent === null) return null;
    if (!(this.size_m > 0)) {
      this.size_m = extent.size_m;
      this.cameras.setSize(extent.size_m);
    }
    return { position_m: extent.middle, quaternion_xyzw: [0, 0, 0, 1] };
  }

  private answer(what: Request | null): void {
    if (what === null) return;
    const turns: Partial<Record<Request, [number, number]>> = { left: [-1, 0], right: [1, 0], up: [0, -1], down: [0, 1] };
    const turn = turns[what];
    if (turn !== undefined) this.cameras.turn(...turn);
    if (what === "fit") this.cameras.fit();
    if (what === "nearer" || what === "farther") this.cameras.approach(what === "nearer");
    if (what === "pick") this.pointing.pickAt(this.stage.width / 2, this.stage.height / 2, 60);
    if (what === "picture") this.savePicture().catch(tell);
  }

  private async savePicture(): Promise<void> {
    const picture = await this.stage.picture();
    if (picture !== null)
      saveFile(`${this.session.log.info.name}_frame_${this.session.log.number(this.session.selection.frame.peek())}.png`, picture);
  }
}

/** Begins to draw in a box; returns what ends it. */
export function startScene(
  box: HTMLElement,
  session: Session,
  legend: Signal<LegendContent | null>,
  report: Signal<SceneReport | null>,
): () => void {
  const runner = new SceneRunner(box, session, legend, report);
  return () => runner.destroy();
}
