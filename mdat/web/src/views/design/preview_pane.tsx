// The panel of the preview: which scenario and range, the picture, and what it counts.
import { useSignal } from "@preact/signals";
import { useEffect, useMemo, useRef } from "preact/hooks";
import type { Mission } from "../../design/mission.ts";
import { Preview, type PreviewAnswer } from "../../design/preview.ts";
import { lengthText } from "../../maths/scales.ts";
import { norm } from "../../maths/vectors.ts";
import { Empty, IconButton, Panel } from "../../parts/controls.tsx";
import { firstScenario } from "../live/choice.ts";
import { type PreviewView, startPreview } from "./preview_scene.ts";

function Tools({ mission, preview, onFit }: { mission: Mission; preview: Preview; onFit: () => void }) {
  const shown = preview.shown.value;
  return (
    <>
      <select
        aria-label="Scenario of the preview"
        value={shown?.scenario ?? ""}
        onChange={(event) => preview.choose(event.currentTarget.value)}
      >
        {mission.scenarios.value.map(({ name }) => (
          <option key={name} value={name}>
            {name}
          </option>
        ))}
      </select>
      {shown === null || shown.ranges_m.length < 2 ? null : (
        <select
          aria-label="Range of the preview"
          value={shown.run}
          onChange={(event) => {
            preview.run.value = Number(event.currentTarget.value);
          }}
        >
          {shown.ranges_m.map((range_m, i) => (
            <option key={`${i} ${range_m}`} value={i}>
              {range_m} m
            </option>
          ))}
        </select>
      )}
      <IconButton icon="fit" label="Fit the target into the preview" stroke="f" onClick={onFit} />
    </>
  );
}

/** Where a further sensor stands, if it is aside. */
function placeText({ own }: PreviewAnswer): string {
  const places = own.position_m.map((x) => Number(x.toFixed(3))).join(", ");
  return norm(own.position_m) === 0 ? "" : `, from ${places} m (right, down, ahead)`;
}

/** How much of a plane across the boresight is seen at a range. */
function fieldText({ camera }: PreviewAnswer, range_m: number): string {
  const [across, down] = camera.frustum_deg.map((angle) => lengthText(2 * range_m * Math.tan((angle * Math.PI) / 360)));
  return `a field of ${across} by ${down}`;
}

function countsOf(answer: PreviewAnswer, hits: number): string {
  const { sensor, ranges_m, run, rays, remark } = answer;
  const counts = `${sensor} at ${lengthText(ranges_m[run])}${placeText(answer)}: ${rays.hit.length} rays, ${hits} on the target; ${fieldText(answer, ranges_m[run])}`;
  return remark === "" ? counts : `${counts}; ${remark}`;
}

/** Draws as long as the panel is there; the failure of a browser without WebGL is told in its place. */
function useScene(preview: Preview) {
  const box = useRef<HTMLDivElement>(null);
  const view = useRef<PreviewView | null>(null);
  const failed = useSignal("");
  useEffect(() => {
    const stop = preview.follow();
    try {
      view.current = startPreview(box.current!, preview);
    } catch (error) {
      failed.value = String(error);
    }
    return () => {
      stop();
      view.current?.destroy();
      view.current = null;
    };
  }, [preview]);
  return { box, view, failed };
}

export function PreviewPane({ mission }: { mission: Mission }) {
  const preview = useMemo(() => new Preview(mission, firstScenario(mission.scenarios.peek())), [mission]);
  const { box, view, failed } = useScene(preview);
  const shown = preview.shown.value;
  return (
    <Panel id="preview" title="Preview" tools={<Tools mission={mission} preview={preview} onFit={() => view.current?.fit()} />}>
      <div class="preview">
        <div
          ref={box}
          class="stage"
          tabIndex={0}
          role="application"
          aria-label="3D preview of sensor, scan and target; arrows turn it, Page up and down go nearer and farther, F fits"
          onKeyDown={(event) => {
            if (!event.ctrlKey && view.current?.press(event.key)) event.preventDefault();
          }}
        />
        {failed.value === "" ? null : <Empty title="The browser cannot draw in 3D.">WebGL 2 is needed: {failed.value}</Empty>}
        {preview.problem.value === "" ? null : (
          <p class="older" role="status">
            <strong>{shown === null ? "No picture yet." : "The picture is of an older text."}</strong> {preview.problem.value}
          </p>
        )}
        {shown === null ? null : <p class="preview-counts">{countsOf(shown, preview.hits.value)}</p>}
      </div>
    </Panel>
  );
}
