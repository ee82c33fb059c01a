// One plot: its values with what they are at the cursor, the chart (or a table), and statistics.
import { useEffect, useRef } from "preact/hooks";
import type { Series } from "../../api/decode.ts";
import type { Statistics, ValueInfo } from "../../api/types.ts";
import { shortLabel } from "../../api/units.ts";
import { openOverlay } from "../../app/overlay.ts";
import { followPointer } from "../../app/pointer.ts";
import { type Session, useSession } from "../../app/session.ts";
import { theme } from "../../app/theme.ts";
import { countText, shortNumber, timeText } from "../../maths/scales.ts";
import { IconButton, saveFile } from "../../parts/controls.tsx";
import { useSize } from "../../parts/use_size.ts";
import { Chart, seriesColour } from "./chart.ts";
import type { Plot } from "./choice.ts";
import { plotData, thinned, timeOfLargest, valueAt } from "./data.ts";
import { plotPicture } from "./picture.ts";
import { useSeries, useStatistics } from "./use_series.ts";

const ROWS = 200;

interface PaneParts {
  session: Session;
  values: ValueInfo[];
  series: Series[];
}

/** The chart in its element, made anew when values, size or theme change. */
function ChartBox({ session, values, series, onChart }: PaneParts & { onChart: (chart: Chart | null) => void }) {
  const box = useRef<HTMLDivElement>(null);
  const chart = useRef<Chart | null>(null);
  const size = useSize(box);
  const { selection } = session;
  const { width, height } = size.value;
  const made = [values.map((value) => value.id).join(), theme.value, width > 0];
  useEffect(() => {
    if (box.current === null || width === 0) return undefined;
    const own = new Chart(box.current, values, plotData(series), selection.window.peek(), width, height);
    chart.current = own;
    onChart(own);
    const stop = followPointer(own.over, { session, timeAt: (event) => own.timeAt(event, selection.window.peek()), drag: "span" });
    return () => {
      stop();
      own.destroy();
      chart.current = null;
      onChart(null);
    };
  }, made);
  useEffect(() => chart.current?.setData(plotData(series), selection.window.peek()), [series]);
  useEffect(() => {
    if (width > 0) chart.current?.setSize(width, height);
  }, [width, height]);
  const window = selection.window.value;
  const { time_s, hovered_s, span } = selection;
  useEffect(() => chart.current?.setWindow(window), [window]);
  useEffect(
    () => chart.current?.setMarks(time_s.value, hovered_s.value, span.value),
    [time_s.value, hovered_s.value, span.value, window, series, width, ...made],
  );
  return (
    <div
      ref={box}
      class="chart"
      role="img"
      aria-label={`Plot of ${values.map((value) => shortLabel(value.label)).join(", ")} over time; the button Tables shows its numbers`}
    />
  );
}

/** A number, or the name of the choice that it stands for. */
function valueText(value: ValueInfo, x: number | null): string {
  return (x === null ? undefined : value.choices?.[x]) ?? shortNumber(x, 4);
}

function Legend({ plot, session, values, series }: PaneParts & { plot: Plot }) {
  const { selection, plots, history } = session;
  const at_s = selection.hovered_s.value ?? selection.time_s.value;
  return (
    <ul class="legend">
      {values.map((value, i) => (
        <li key={value.id}>
          <i class="swatch" style={{ background: `var(${seriesColour(i)})` }} />
          <span class="legend-label" title={`${value.label} (${value.topic})`}>
            <span class="legend-name">{shortLabel(value.label)}</span>
            {value.unit === "" ? null : <span>, {value.unit}</span>}
          </span>
          <b>{series[i] === undefined ? "" : valueText(value, valueAt(series[i], at_s))}</b>
          {values.length > 1 ? (
            <IconButton
              icon="close"
              label={`Take ${shortLabel(value.label)} away`}
              onClick={() => history.run(plots.removeValue(plot.key, value.id))}
            />
          ) : null}
        </li>
      ))}
    </ul>
  );
}

const COLUMNS: [keyof Statistics, string, string][] = [
  ["mean", "mean", "mean"],
  ["sigma", "σ", "standard deviation"],
  ["min", "min", "least"],
  ["median", "med", "median"],
  ["p95", "95 %", "95 % are not above it"],
  ["max", "max", "largest"],
  ["rms", "RMS", "root mean square"],
  ["count", "n", "number of values"],
];

/** Dashes keep the room until the numbers are there. */
const NOT_YET = Object.fromEntries(COLUMNS.map(([name]) => [name, null])) as unknown as Statistics;

function statisticText(found: Statistics, name: keyof Statistics): string {
  return name === "count" ? countText(found.count) : shortNumber(found[name]);
}

/** Statistics of the span, or of what is shown; the largest value can be gone to. */
function StatisticsLine({ session, values, series }: PaneParts) {
  const { selection, log, player } = session;
  const statistics = useStatistics(
    log,
    values.map((value) => value.id),
    selection.span.value ?? selection.window.value,
  ).value;
  return (
    <>
      {values.map((value, i) => {
        const found = statistics.get(value.id) ?? NOT_YET;
        return (
          <dl class="statistics" key={value.id} aria-label={`Statistics of ${value.label}`}>
            {COLUMNS.map(([name, label, meaning]) => (
              <div key={name}>
                <dt>
                  <abbr title={meaning}>{label}</abbr>
                </dt>
                <dd>
                  {name === "max" && series[i] !== undefined ? (
                    <button
                      type="button"
                      class="link"
                      title="Go to the largest value shown"
                      onClick={() => goToLargest(series[i], player, selection)}
                    >
                      {shortNumber(found.max)}
                    </button>
                  ) : (
                    statisticText(found, name)
                  )}
                </dd>
              </div>
            ))}
          </dl>
        );
      })}
    </>
  );
}

function goToLargest(series: Series, player: Session["player"], selection: Session["selection"]): void {
  const time_s = timeOfLargest(series);
  player.pause();
  if (Number.isFinite(time_s)) selection.setTime(time_s + 1e-6);
}

function Table({ values, series }: PaneParts) {
  const times = series[0]?.time_s ?? new Float64Array();
  return (
    <div class="scroll" tabIndex={0} role="group" aria-label={`Table of ${values.map((value) => shortLabel(value.label)).join(", ")}`}>
      <table class="table">
        <thead>
          <tr>
            <th scope="col" class="number">
              Time, s
            </th>
            {values.map((value) => (
              <th key={value.id} scope="col" class="number">
                {shortLabel(value.label)}
                {value.unit === "" ? "" : `, ${value.unit}`}
              </th>
            ))}
          </tr>
        </thead>
        <tbody>
          {thinned(times.length, ROWS).map((row) => (
            <tr key={row}>
              <td class="number">{timeText(times[row], 0.001)}</td>
              {series.map((each, i) => (
                <td key={values[i]?.id ?? i} class="number">
                  {shortNumber(valueAt(each, times[row]), 5)}
                </td>
              ))}
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}

export function PlotPane({ plot }: { plot: Plot }) {
  const session = useSession();
  const { plots, selection, log, history } = session;
  const chart = useRef<Chart | null>(null);
  const box = useRef<HTMLDivElement>(null);
  const size = useSize(box);
  const values = plot.values.map((id) => plots.value(id)).filter((value): value is ValueInfo => value !== undefined);
  const series = useSeries(log, plot.values, selection.window.value, Math.max(0, Math.min(2000, size.value.width))).value;
  const title = values.map((value) => shortLabel(value.label)).join(", ");
  const save = async () => {
    const picture =
      chart.current === null
        ? null
        : await plotPicture(chart.current.canvas, `${title}${values[0]?.unit ? `, ${values[0].unit}` : ""}: ${log.info.name}`);
    if (picture !== null) saveFile(`${plot.values.join("_")}.png`, picture);
  };
  const add = () => {
    plots.addTo.value = plot.key;
    openOverlay("values");
  };
  const parts = { session, values, series: series !== null && series.length === values.length ? series : [] };
  return (
    <article ref={box} class="plot" aria-label={title}>
      <header>
        <Legend {...parts} plot={plot} />
        <div class="panel-tools">
          <IconButton icon="add" label={`Add a value in ${values[0]?.unit || "the same unit"}`} onClick={add} />
          <IconButton icon="picture" label="Save this plot as a PNG picture" disabled={plots.asTable.value} onClick={save} />
          <IconButton icon="close" label={`Close the plot of ${title}`} onClick={() => history.run(plots.remove(plot.key))} />
        </div>
      </header>
      {plots.asTable.value ? (
        <Table {...parts} />
      ) : parts.series.length === 0 ? (
        <div class="chart" />
      ) : (
        <ChartBox
          {...parts}
          onChart={(made) => {
            chart.current = made;
          }}
        />
      )}
      <StatisticsLine {...parts} />
    </article>
  );
}
