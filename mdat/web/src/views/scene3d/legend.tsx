// The scale of colours with its numbers, or the classes with their counts.
import { classColour, cssColour, rampGradient } from "../../maths/ramps.ts";
import { shortNumber } from "../../maths/scales.ts";
import type { LegendContent } from "./colours.ts";

export function Legend({ content }: { content: LegendContent }) {
  const { title, unit, ramp, low, high, classes, lack, notes } = content;
  return (
    <div class="scene-legend" role="group" aria-label={`Colours: ${title}`}>
      <strong>
        {title}
        {unit === "" ? "" : `, ${unit}`}
      </strong>
      {ramp === null ? null : (
        <>
          <div class="ramp" style={{ background: rampGradient(ramp) }} />
          <div class="ramp-numbers">
            <span>{shortNumber(low)}</span>
            <span>{shortNumber((low + high) / 2)}</span>
            <span>{shortNumber(high)}</span>
          </div>
        </>
      )}
      {lack === "" ? null : <span>{lack}</span>}
      {classes.length === 0 ? null : (
        <ul>
          {classes.map((each) => (
            <li key={each.index}>
              <i class="swatch" style={{ background: cssColour(classColour(each.index)) }} /> {each.label} <b>{each.count}</b>
            </li>
          ))}
        </ul>
      )}
      {notes.map((note) => (
        <span key={note} class="note">
          {note}
        </span>
      ))}
    </div>
  );
}
