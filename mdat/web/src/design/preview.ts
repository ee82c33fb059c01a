// What a scan of the edited text would look like, as the server answers; the last good answer stays while the text has a problem.
import { batch, computed, effect, type ReadonlySignal, type Signal, signal } from "@preact/signals";
import { postBinary, postJson, withQuery } from "../api/client.ts";
import type { Scan } from "../api/decode.ts";
import type { CameraInfo, PoseData } from "../api/types.ts";
import { tell } from "../app/notices.ts";
import type { Mission } from "./mission.ts";

/** The answer of /api/mission/preview; of a text with a problem this alone. */
export interface PreviewAnswer {
  problem?: string;
  scenario: string;
  run: number;
  ranges_m: number[];
  sensor: string;
  camera: CameraInfo;
  /** T_sensor_target. */
  pose: PoseData;
  /** Where the sensor that scans stands in the sensor frame; rays and field of view are in its own one. */
  own: PoseData;
  size_m: number;
  /** The same as long as the surface is. */
  surface: string;
  remark: string;
  rays: { x: number[]; y: number[]; z: number[]; age_s: number[]; hit: number[] };
}

const WAIT_MS = 250;

/** The rays as a scan of a recording: places of returns, and where the others pass the target. */
export function scanOf({ rays }: PreviewAnswer): Scan {
  const unknown = () => new Float32Array(rays.x.length).fill(Number.NaN);
  const columns = {
    x: Float32Array.from(rays.x),
    y: Float32Array.from(rays.y),
    z: Float32Array.from(rays.z),
    age_s: Float32Array.from(rays.age_s),
    state: Float32Array.from(rays.hit, (hit) => 1 - hit),
    residual_m: unknown(),
    sigma_m: unknown(),
    range_m: unknown(),
    part: unknown(),
  };
  return { count: rays.x.length, columns };
}

export class Preview {
  readonly scenario: Signal<string>;
  readonly run: Signal<number> = signal(0);
  readonly shown: Signal<PreviewAnswer | null> = signal(null);
  /** Why what is shown is not the text's. */
  readonly problem: Signal<string> = signal("");
  readonly hits: ReadonlySignal<number> = computed(() => this.shown.value?.rays.hit.reduce((sum, hit) => sum + hit, 0) ?? 0);
  private readonly mission: Mission;
  /** The text of what is shown. */
  private shownText = "";
  private asked = 0;

  /** Of a scenario of this name at first; then of the one that is designed. */
  constructor(mission: Mission, scenario: string) {
    this.mission = mission;
    this.scenario = signal(scenario);
  }

  /** Asks anew at each change, once the changes pause; gives what ends it. */
  follow(): () => void {
    let timer: ReturnType<typeof setTimeout> | undefined;
    const stopChoosing = effect(() => {
      const [table, name] = this.mission.section.value.split(".");
      if (table === "scenario") batch(() => this.choose(name));
    });
    const stop = effect(() => {
      const wish = { text: this.mission.text.value, scenario: this.scenario.value, run: this.run.value };
      clearTimeout(timer);
      timer = setTimeout(() => this.ask(wish).catch(tell), this.shown.peek() === null ? 0 : WAIT_MS);
    });
    return () => {
      ++this.asked;
      clearTimeout(timer);
      stopChoosing();
      stop();
    };
  }

  choose(scenario: string): void {
    if (scenario !== this.scenario.peek()) this.run.value = 0;
    this.scenario.value = scenario;
  }

  private async ask(wish: { text: string; scenario: string; run: number }): Promise<void> {
    const mine = ++this.asked;
    const answer = await postJson<PreviewAnswer>(withQuery("/api/mission/preview", { id: this.mission.id }), wish);
    if (mine !== this.asked) return;
    this.problem.value = answer.problem ?? "";
    if (answer.problem !== undefined) return;
    this.shownText = wish.text;
    this.shown.value = answer;
  }

  /** The surface of what is shown as binary glTF; the text may have a problem by now. */
  surface(): Promise<ArrayBuffer> {
    return postBinary(withQuery("/api/mission/surface", { id: this.mission.id }), { text: this.shownText });
  }
}
