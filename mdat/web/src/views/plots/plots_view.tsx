// The plots of chosen values on the common axis of time.
import { openOverlay } from "../../app/overlay.ts";
import { useSession } from "../../app/session.ts";
import { timeText } from "../../maths/scales.ts";
import { Empty, IconButton, Panel } from "../../parts/controls.tsx";
import { Icon } from "../../parts/icon.tsx";
import { PlotPane } from "./pane.tsx";

export function PlotsView() {
  const { plots, selection, log } = useSession();
  const span = selection.span.value;
  const range = span ?? selection.window.value;
  const all = plots.plots.value.flatMap((plot) => plot.values);
  const tools = (
    <>
      <span class="range" role="status">
        {span === null ? "Shown" : "Span"} {timeText(range.from_s, 0.1)} to {timeText(range.to_s, 0.1)} s
      </span>
      {all.length === 0 ? null : (
        <a
          class="text-button"
          href={log.csvPath([...new Set(all)], range.from_s, range.to_s)}
          download={`${log.info.name}.csv`}
          title="All plotted values of the span as CSV"
        >
          <Icon name="download" /> CSV
        </a>
      )}
      <IconButton
        icon="table"
        label="Tables in place of plots"
        pressed={plots.asTable.value}
        onClick={() => {
          plots.asTable.value = !plots.asTable.peek();
        }}
      />
      <button
        type="button"
        class="text-button"
        title="Add a plot (P)"
        onClick={() => {
          plots.addTo.value = null;
          openOverlay("values");
        }}
      >
        <Icon name="add" /> Plot
      </button>
    </>
  );
  return (
    <Panel id="plots" title="Plots" tools={tools}>
      {plots.plots.value.length === 0 ? (
        <Empty title="Nothing is plotted.">Press P, or the button “Plot”, and choose a value.</Empty>
      ) : (
        <div class="plot-row">
          {plots.plots.value.map((plot) => (
            <PlotPane key={plot.key} plot={plot} />
          ))}
        </div>
      )}
    </Panel>
  );
}
