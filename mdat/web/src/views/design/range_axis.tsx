// Thresholds of ranges on one axis: which sensor is used from where to where, where scanning part by part begins, where scenarios begin.
import { type Signal, useSignal } from "@preact/signals";
import type { Mission } from "../../design/mission.ts";
import {
  axisOf,
  type RangeAxis,
  type RangeRow,
  rangeAt,
  rangeRows,
  shareOf,
  stepped,
  type Threshold,
  withRange,
} from "../../design/ranges.ts";

/** A threshold that is dragged, until it is let go. */
interface Dragged {
  threshold: Threshold;
  value_m: number;
}

const isSame = (a: Threshold, b: Threshold): boolean => a.key === b.key && a.index === b.index;
const percent = (share: number): string => `${(100 * share).toFixed(2)}%`;

function sectionOf(key: string): string {
  return /^(?:further_sensor|part|scenario)\./.test(key) ? key.split(".").slice(0, 2).join(".") : key.split(".")[0];
}

/** Goes to the field of a key. */
function show(mission: Mission, key: string): void {
  mission.filter.value = "";
  mission.section.value = sectionOf(key);
  requestAnimationFrame(() => document.getElementById(`field-${key}`)?.focus());
}

interface MarkProps {
  mission: Mission;
  axis: RangeAxis;
  threshold: Threshold;
  dragged: Signal<Dragged | null>;
}

/** One threshold: dragged, moved by arrow keys, and by a click or Enter the way to its field. */
function Mark({ mission, axis, threshold, dragged }: MarkProps) {
  const { key } = threshold;
  const held = dragged.value !== null && isSame(dragged.value.threshold, threshold) ? dragged.value.value_m : null;
  const value_m = held ?? threshold.value_m;
  const set = (next_m: number) => mission.set(key, withRange(mission.byKey.peek(), threshold, next_m));
  const move = (event: PointerEvent) => {
    const mark = event.currentTarget as HTMLElement;
    if (!mark.hasPointerCapture(event.pointerId) || mission.shipped) return;
    const { left, width } = mark.parentElement!.getBoundingClientRect();
    dragged.value = { threshold, value_m: rangeAt(axis, (event.clientX - left) / width) };
  };
  const release = () => {
    dragged.value = null;
    if (held === null || held === threshold.value_m) show(mission, key);
    else set(held);
  };
  const press = (event: KeyboardEvent) => {
    const step = { ArrowRight: true, ArrowUp: true, ArrowLeft: false, ArrowDown: false }[event.key];
    if (event.key === "Enter") show(mission, key);
    else if (step === undefined || mission.shipped) return;
    else set(stepped(threshold.value_m, step));
    event.preventDefault();
  };
  return (
    <span
      class="range-mark"
      role="slider"
      tabIndex={0}
      aria-label={threshold.index === null ? key : `${key} ${threshold.index + 1}`}
      aria-valuenow={value_m}
      aria-valuemin={0}
      aria-valuemax={axis.high_m}
      aria-valuetext={`${value_m} m`}
      aria-readonly={mission.shipped}
      title={`${key}: ${value_m} m`}
      style={{ left: percent(shareOf(axis, value_m)) }}
      onPointerDown={(event) => event.currentTarget.setPointerCapture(event.pointerId)}
      onPointerMove={move}
      onPointerUp={release}
      onKeyDown={press}
    >
      {held === null ? null : <output>{held} m</output>}
    </span>
  );
}

function Bar({ axis, band_m }: { axis: RangeAxis; band_m: [number, number] }) {
  const [from, to] = band_m.map((value_m) => shareOf(axis, value_m));
  return <span class="range-bar" style={{ left: percent(from), width: percent(Math.max(0, to - from)) }} />;
}

function Row({ row, section, ...rest }: { row: RangeRow; section: string } & Omit<MarkProps, "threshold">) {
  const own = row.thresholds.some(({ key }) => sectionOf(key) === section);
  return (
    <div class={`range-row${own ? " own" : ""}`} title={row.meaning}>
      <span class="range-name">{row.name}</span>
      <span class="range-line">
        {row.band_m === null ? null : <Bar axis={rest.axis} band_m={row.band_m} />}
        {row.thresholds.map((threshold) => (
          <Mark key={`${threshold.key} ${threshold.index}`} {...rest} threshold={threshold} />
        ))}
      </span>
    </div>
  );
}

/** Above the form of a table that has thresholds of ranges. */
export function RangeAxisFigure({ mission }: { mission: Mission }) {
  const dragged = useSignal<Dragged | null>(null);
  const section = mission.section.value;
  const rows = rangeRows(mission.byKey.value, section);
  const axis = axisOf(rows);
  if (rows.length === 0) return null;
  return (
    <figure class="range-axis" aria-label="Ranges of the target at which things change">
      {rows.map((row) => (
        <Row key={row.name} row={row} section={section} mission={mission} axis={axis} dragged={dragged} />
      ))}
      <div class="range-row range-ticks" aria-hidden="true">
        <span class="range-name">range, m</span>
        <span class="range-line">
          {axis.ticks_m.map((tick_m) => (
            <span key={tick_m} class="range-tick" style={{ left: percent(shareOf(axis, tick_m)) }}>
              {tick_m}
            </span>
          ))}
        </span>
      </div>
      <figcaption>
        {mission.shipped ? "A click leads to a range's key." : "Drag a range, or move it by the arrow keys; a click leads to its key."}
      </figcaption>
    </figure>
  );
}
