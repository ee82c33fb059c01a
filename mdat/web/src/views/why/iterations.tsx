// The registration's iterations. One that is chosen colours the scan by its residuals at that iteration's pose.
import type { FrameInfo } from "../../api/types.ts";
import { useSession } from "../../app/session.ts";
import { countText, shortNumber } from "../../maths/scales.ts";

export function Iterations({ frame }: { frame: FrameInfo }) {
  const { selection, scene } = useSession();
  const chosen = selection.iteration.value;
  const choose = (iteration: number | null) => {
    selection.iteration.value = iteration;
    scene.colour.value = "residual";
  };
  if (frame.iterations === null) return <p class="hint">The recording holds no iterations of this frame's registration.</p>;
  return (
    <table class="table">
      <caption>Iterations of the registration: choose one to see its residuals on the scan</caption>
      <thead>
        <tr>
          <th scope="col">Iteration</th>
          <th scope="col" class="number">
            Step, mm
          </th>
          <th scope="col" class="number">
            Step, °
          </th>
          <th scope="col" class="number">
            RMS, mm
          </th>
          <th scope="col" class="number">
            Inliers
          </th>
        </tr>
      </thead>
      <tbody>
        {frame.iterations.map((step, i) => (
          <tr key={String(i)} class={chosen === i ? "chosen" : ""}>
            <th scope="row">
              <button type="button" class="link" aria-pressed={chosen === i} onClick={() => choose(chosen === i ? null : i)}>
                {i === 0 ? "start" : i}
              </button>
            </th>
            <td class="number">{shortNumber(step.step_mm)}</td>
            <td class="number">{shortNumber(step.step_deg)}</td>
            <td class="number">{shortNumber(step.rms_mm)}</td>
            <td class="number">{countText(step.inliers)}</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}
