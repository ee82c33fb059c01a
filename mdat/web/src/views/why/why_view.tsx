// Why the frame's pose was taken or refused: the verdict in a sentence, gates, rays, errors, poses, and the registration's iterations.
import { useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import type { FrameInfo, Gate, PoseData } from "../../api/types.ts";
import { unitText } from "../../api/units.ts";
import { tell } from "../../app/notices.ts";
import { useSession } from "../../app/session.ts";
import { verdictOf } from "../../log/frames.ts";
import { countText, sentence, shortNumber, timeText, withUnit } from "../../maths/scales.ts";
import { angleBetween_deg, norm, subtract } from "../../maths/vectors.ts";
import { Empty, Panel } from "../../parts/controls.tsx";
import { Icon } from "../../parts/icon.tsx";
import { weakNote } from "../scene3d/ellipsoid.ts";
import { Iterations } from "./iterations.tsx";

/** The selected frame as soon as the server has answered; while playing, the last that came. */
export function useFrame() {
  const { log, selection } = useSession();
  const shown = useSignal<FrameInfo | null>(null);
  const index = selection.frame.value;
  useEffect(() => {
    if (log.frames === 0) return;
    log.frame(index).then((frame) => {
      if (frame.index === selection.frame.peek() || selection.frame.peek() !== shown.peek()?.index) shown.value = frame;
    }, tell);
  }, [index, log]);
  return shown;
}

const VERDICTS = {
  unknown: { icon: "info", text: "Not judged" },
  valid: { icon: "check", text: "Valid" },
  refused: { icon: "close", text: "Refused" },
  wrong: { icon: "warning", text: "Valid, but wrong" },
} as const;

function Verdict({ frame }: { frame: FrameInfo }) {
  const { log } = useSession();
  const verdict = verdictOf(frame.valid === null ? Number.NaN : Number(frame.valid), frame.wrong === true ? 1 : 0);
  const { icon, text } = VERDICTS[verdict];
  return (
    <div class="verdict">
      <span class={`chip chip-${verdict}`}>
        <Icon name={icon} /> {text}
      </span>
      {frame.mode === null ? null : <span class="chip">{frame.mode}</span>}
      <span class="verdict-frame">
        frame {log.number(frame.index)}, {timeText(frame.time_s)} s
      </span>
      <p class="why-sentence">
        {sentence(frame.why || frame.reason || "")} {verdict === "wrong" ? wrongText(frame) : ""}
      </p>
    </div>
  );
}

/** What a pose that was trusted is off, where it should not have been. */
function wrongText({ error }: FrameInfo): string {
  return `But the truth says otherwise: it is off by ${withUnit(error?.position_mm, "mm")} and ${withUnit(error?.angle_deg, "°")}.`;
}

function gateNumber(value: number | null, unit: string): string {
  if (value === null || Math.abs(value) >= 1e6) return withUnit(value, unitText(unit));
  return `${Number(value.toPrecision(4))} ${unitText(unit)}`.trim().replace("-", "−");
}

function GateRow({ gate }: { gate: Gate }) {
  return (
    <tr class={gate.pass ? "" : "fails"}>
      <th scope="row">{gate.name}</th>
      <td class="number">{gateNumber(gate.value, gate.unit)}</td>
      <td class="number">
        {gate.kind === undefined ? "" : <abbr title={gate.kind}>{gate.kind === "at least" ? "≥ " : "≤ "}</abbr>}
        {gateNumber(gate.limit, gate.unit)}
      </td>
      <td>
        <span class={gate.pass ? "good" : "bad"}>
          <Icon name={gate.pass ? "check" : "close"} /> {gate.pass ? "passes" : "fails"}
        </span>
      </td>
    </tr>
  );
}

function Gates({ gates }: { gates: Gate[] }) {
  if (gates.length === 0) return <p class="hint">The recording holds no gates of this frame.</p>;
  const order = [...gates].sort((a, b) => Number(a.pass) - Number(b.pass));
  return (
    <table class="table">
      <thead>
        <tr>
          <th scope="col">Gate</th>
          <th scope="col" class="number">
            Value
          </th>
          <th scope="col" class="number">
            Limit
          </th>
          <th scope="col">Result</th>
        </tr>
      </thead>
      <tbody>
        {order.map((gate) => (
          <GateRow key={gate.name} gate={gate} />
        ))}
      </tbody>
    </table>
  );
}

function Fact({ label, value, meaning }: { label: string; value: string; meaning?: string }) {
  return (
    <div title={meaning}>
      <dt>{label}</dt>
      <dd>{value}</dd>
    </div>
  );
}

function Facts({ frame }: { frame: FrameInfo }) {
  const { error } = frame;
  return (
    <dl class="facts">
      <Fact label="Rays" value={countText(frame.rays)} />
      <Fact label="Returns" value={countText(frame.hits)} />
      <Fact label="Missed" value={countText(frame.missed)} />
      <Fact label="Inliers" value={countText(frame.inliers)} />
      <Fact label="Residual, RMS" value={withUnit(frame.rms_mm, "mm")} />
      <Fact label="Position error" value={withUnit(error?.position_mm, "mm")} />
      <Fact label="Angle error" value={withUnit(error?.angle_deg, "°")} />
      <Fact
        label="NEES"
        value={shortNumber(error?.normalised_squared)}
        meaning="Normalised error squared: 6 in the mean, if the covariance is honest"
      />
    </dl>
  );
}

/** Directions that the scan holds badly, in words. */
function Weak({ frame }: { frame: FrameInfo }) {
  if (frame.weak.length === 0) return null;
  return (
    <ul class="weak">
      {frame.weak.map((weak, i) => (
        <li key={String(i)}>{weakNote(weak, i)}</li>
      ))}
    </ul>
  );
}

function PoseRow({ name, pose, truth }: { name: string; pose: PoseData | null; truth: PoseData | null }) {
  if (pose === null) return null;
  const off = truth === null ? null : 1000 * norm(subtract(pose.position_m, truth.position_m));
  const turned = truth === null ? null : angleBetween_deg(pose.quaternion_xyzw, truth.quaternion_xyzw);
  return (
    <tr>
      <th scope="row">{name}</th>
      <td class="number">{pose.position_m.map((x) => shortNumber(x, 4)).join("  ")}</td>
      <td class="number">{pose.quaternion_xyzw.map((x) => x.toFixed(4).replace("-", "−")).join("  ")}</td>
      <td class="number">{pose === truth ? "" : `${withUnit(off, "mm")}, ${withUnit(turned, "°")}`}</td>
    </tr>
  );
}

function Poses({ frame }: { frame: FrameInfo }) {
  const { estimate, filtered, truth } = frame.poses;
  return (
    <details>
      <summary>Poses of the target in the sensor's frame</summary>
      <div class="scroll-x" tabIndex={0}>
        <table class="table">
          <thead>
            <tr>
              <th scope="col">Pose</th>
              <th scope="col" class="number">
                x y z, m
              </th>
              <th scope="col" class="number">
                quaternion x y z w
              </th>
              <th scope="col" class="number">
                off the truth
              </th>
            </tr>
          </thead>
          <tbody>
            <PoseRow name="estimate" pose={estimate} truth={truth} />
            <PoseRow name="filter" pose={filtered} truth={truth} />
            <PoseRow name="truth" pose={truth} truth={truth} />
          </tbody>
        </table>
      </div>
    </details>
  );
}

export function WhyView() {
  const { log } = useSession();
  const frame = useFrame().value;
  return (
    <Panel id="why" title="Why">
      <div class="scroll" tabIndex={0} role="group" aria-label="Why this frame's pose was taken or refused">
        {log.frames === 0 ? (
          <Empty title="This recording has no frames.">Record a run with mdat run MISSION --record FILE.mcap.</Empty>
        ) : null}
        {frame === null ? null : (
          <>
            <Verdict frame={frame} />
            <Gates gates={frame.gates} />
            <Facts frame={frame} />
            <Weak frame={frame} />
            <Iterations frame={frame} />
            <Poses frame={frame} />
          </>
        )}
      </div>
    </Panel>
  );
}
