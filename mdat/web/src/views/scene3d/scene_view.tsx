// The panel of the 3D view. Its tools are there at once; three.js is loaded when the view is first shown.
import { useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { setting } from "../../app/history.ts";
import { tell } from "../../app/notices.ts";
import { useSession } from "../../app/session.ts";
import { lengthText } from "../../maths/scales.ts";
import { norm, subtract } from "../../maths/vectors.ts";
import { Empty, IconButton, Panel } from "../../parts/controls.tsx";
import { Icon } from "../../parts/icon.tsx";
import { CAMERAS, COLOURS, type ColourName, LAYERS } from "./choice.ts";
import type { LegendContent } from "./colours.ts";
import { Legend } from "./legend.tsx";
import type { SceneReport } from "./scene.ts";

function Cameras() {
  const { scene } = useSession();
  return (
    <div class="segments" role="group" aria-label="Camera">
      {CAMERAS.map((camera, i) => (
        <button
          key={camera.id}
          type="button"
          title={`${camera.help} (${i + 1})`}
          aria-pressed={scene.camera.value === camera.id}
          onClick={() => {
            scene.camera.value = camera.id;
          }}
        >
          {camera.label}
        </button>
      ))}
    </div>
  );
}

function Layers() {
  const { scene } = useSession();
  return (
    <details class="menu">
      <summary title="What is shown">
        <Icon name="layers" /> Show
      </summary>
      <fieldset>
        <legend class="unseen">Shown in 3D</legend>
        {LAYERS.map((layer) => (
          <label key={layer.id}>
            <input type="checkbox" checked={scene.layers.value[layer.id]} onChange={() => scene.toggle(layer.id)} /> {layer.label}
          </label>
        ))}
      </fieldset>
    </details>
  );
}

function Tools() {
  const { scene, history } = useSession();
  return (
    <>
      <label class="inline">
        <span>Colour</span>
        <select
          aria-label="Colour of points"
          title="Colour of points (C)"
          value={scene.colour.value}
          onChange={(event) => history.run(setting("colour of points", scene.colour, event.currentTarget.value as ColourName))}
        >
          {COLOURS.map((colour) => (
            <option key={colour.id} value={colour.id}>
              {colour.label}
            </option>
          ))}
        </select>
      </label>
      <Layers />
      <Cameras />
      <IconButton icon="fit" label="Fit the target into the view" stroke="f" onClick={() => scene.ask("fit")} />
      <IconButton
        icon="ruler"
        label="Measure between two points"
        stroke="m"
        pressed={scene.measuring.value}
        onClick={() => scene.toggleMeasuring()}
      />
      <IconButton icon="picture" label="Save the view as a PNG picture" onClick={() => scene.ask("picture")} />
    </>
  );
}

/** What measuring waits for, and what was measured. */
function Measurements() {
  const { scene, history } = useSession();
  const list = scene.measurements.value;
  if (!scene.measuring.value && list.length === 0) return null;
  return (
    <div class="measurements" role="status">
      {scene.measuring.value ? (
        <p>
          {scene.firstPoint.value === null ? "Measuring: choose the first point." : "Choose the second point."} Click it, or turn the view
          with Ctrl and arrows and press Enter at the cross.
        </p>
      ) : null}
      {list.map(({ a, b }, i) => (
        <p key={String(i)}>
          Distance {i + 1}: <b>{lengthText(norm(subtract(b, a)))}</b>
        </p>
      ))}
      {list.length === 0 ? null : (
        <button type="button" class="text-button" onClick={() => history.run(setting("clearing the measurements", scene.measurements, []))}>
          Clear
        </button>
      )}
    </div>
  );
}

function Reading({ report }: { report: SceneReport | null }) {
  if (report === null || report.pointText === "") return null;
  return (
    <div class="point-reading" role="status">
      {report.pointText}
    </div>
  );
}

export function SceneView() {
  const session = useSession();
  const box = useRef<HTMLDivElement>(null);
  const legend = useSignal<LegendContent | null>(null);
  const report = useSignal<SceneReport | null>(null);
  const failed = useSignal<string | null>(null);
  useEffect(() => {
    let end: (() => void) | null = null;
    let gone = false;
    import("./scene.ts").then(
      ({ startScene }) => {
        if (gone || box.current === null) return;
        try {
          end = startScene(box.current, session, legend, report);
        } catch (error) {
          failed.value = error instanceof Error ? error.message : String(error);
        }
      },
      (error) => tell(error),
    );
    return () => {
      gone = true;
      end?.();
    };
  }, [session]);
  const { scene, log } = session;
  return (
    <Panel id="scene" title="3D" tools={<Tools />}>
      <div
        ref={box}
        class="stage"
        tabIndex={0}
        role="application"
        aria-label="3D view of sensor and target; Ctrl and arrows turn it, Page up and down go nearer and farther"
      />
      {failed.value === null ? null : (
        <Empty title="The browser cannot draw in 3D.">WebGL 2 is needed: {failed.value}. Plots, events and “Why” work without it.</Empty>
      )}
      {log.frames === 0 ? <Empty title="This recording has no scans.">Record a run with mdat run MISSION --record FILE.mcap.</Empty> : null}
      {scene.measuring.value ? <div class="cross" aria-hidden="true" /> : null}
      {legend.value === null ? null : <Legend content={legend.value} />}
      <Reading report={report.value} />
      <Measurements />
    </Panel>
  );
}
