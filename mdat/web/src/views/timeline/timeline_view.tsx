// The time line of the whole recording, and what plays it.
import { useEffect, useMemo, useRef } from "preact/hooks";
import { jumpToEvent, jumpToVerdict, markSpan, playOrPause, stepForward, toggleLoop } from "../../app/actions.ts";
import { followPointer } from "../../app/pointer.ts";
import { type Session, useSession } from "../../app/session.ts";
import { cssValue, theme } from "../../app/theme.ts";
import { runsOf } from "../../log/frames.ts";
import { PLAYER_SPEEDS } from "../../log/player.ts";
import { timeText } from "../../maths/scales.ts";
import { IconButton } from "../../parts/controls.tsx";
import { Icon } from "../../parts/icon.tsx";
import { textScale } from "../../parts/rem.ts";
import { useSize } from "../../parts/use_size.ts";
import { drawTimeline, type TimelineColours, timeToX, xToTime } from "./draw.ts";

function coloursNow(): TimelineColours {
  return {
    text: cssValue("--text-2"),
    line: cssValue("--line"),
    ground: cssValue("--panel"),
    verdicts: { unknown: cssValue("--line-2"), valid: cssValue("--valid"), refused: cssValue("--refused"), wrong: cssValue("--wrong") },
    events: { info: cssValue("--text-3"), warning: cssValue("--refused"), error: cssValue("--wrong") },
    modes: [cssValue("--mode-a"), cssValue("--mode-b")],
  };
}

function Track({ session }: { session: Session }) {
  const box = useRef<HTMLDivElement>(null);
  const canvas = useRef<HTMLCanvasElement>(null);
  const size = useSize(box);
  const { selection, log, events } = session;
  const modeRuns = useMemo(() => runsOf(log.columns.mode), [log, log.frames]);
  const { width, height } = size.value;
  const window = selection.window.value;
  useEffect(() => {
    if (canvas.current === null || width === 0) return;
    drawTimeline(
      canvas.current,
      { columns: log.columns, modes: log.info.modes ?? [], modeRuns, events: events.all.value, window },
      coloursNow(),
      size.value,
      textScale(),
    );
  }, [width, height, window, events.all.value, theme.value, log.frames]);
  useEffect(() => {
    const element = box.current!;
    const timeAt = (event: MouseEvent) => {
      const place = element.getBoundingClientRect();
      return xToTime(event.clientX - place.left, selection.window.peek(), place.width);
    };
    return followPointer(element, { session, timeAt, drag: "time" });
  }, [session]);
  return (
    <div
      ref={box}
      class="track"
      role="slider"
      tabIndex={0}
      aria-label="Time"
      aria-valuemin={0}
      aria-valuemax={Math.max(0, log.frames - 1)}
      aria-valuenow={selection.frame.value}
      aria-valuetext={`frame ${log.number(selection.frame.value)}, ${timeText(selection.time_s.value)} seconds`}
    >
      <canvas ref={canvas} />
      <Marks session={session} width={width} />
    </div>
  );
}

/** The cursor and the span, above the canvas: they move without drawing it anew. */
function Marks({ session, width }: { session: Session; width: number }) {
  const { selection } = session;
  const window = selection.window.value;
  const x = (time_s: number) => timeToX(time_s, window, width);
  const span = selection.span.value;
  const hovered_s = selection.hovered_s.value;
  return (
    <>
      {span === null ? null : (
        <div
          class={`span${selection.loop.value ? " looped" : ""}`}
          style={{ left: `${x(span.from_s)}px`, width: `${x(span.to_s) - x(span.from_s)}px` }}
        />
      )}
      {hovered_s === null ? null : <div class="hover-line" style={{ transform: `translateX(${x(hovered_s)}px)` }} />}
      <div class="cursor-line" style={{ transform: `translateX(${x(selection.time_s.value)}px)` }} />
    </>
  );
}

function Transport({ session }: { session: Session }) {
  const { player } = session;
  const playing = player.playing.value;
  const forward = playing && player.direction.value === 1;
  const reverse = playing && player.direction.value === -1;
  return (
    <div class="transport" role="group" aria-label="Play">
      <IconButton icon="first" label="First frame" stroke="Home" onClick={() => player.goTo(0)} />
      <IconButton icon="stepBack" label="Frame before" stroke="ArrowLeft" onClick={() => player.step(-1)} />
      <IconButton
        icon={reverse ? "pause" : "reverse"}
        label={reverse ? "Pause" : "Play in reverse"}
        stroke="j"
        onClick={() => (reverse ? player.pause() : player.play(-1))}
      />
      <button
        type="button"
        class="play-button"
        title={`${forward ? "Pause" : "Play"} (Space)`}
        aria-label={forward ? "Pause" : "Play"}
        onClick={() => (forward ? player.pause() : playOrPause(session))}
      >
        <Icon name={forward ? "pause" : "play"} />
      </button>
      <IconButton icon="stepForward" label="Next frame" stroke="ArrowRight" onClick={() => stepForward(session)} />
      <IconButton icon="last" label="Last frame" stroke="End" onClick={() => player.goTo(session.log.frames - 1)} />
      <select
        aria-label="Speed"
        title="Speed (, and .)"
        value={player.speed.value}
        onChange={(event) => {
          player.speed.value = Number(event.currentTarget.value);
        }}
      >
        {PLAYER_SPEEDS.map((speed) => (
          <option key={speed} value={speed}>
            {speed} ×
          </option>
        ))}
      </select>
    </div>
  );
}

function Where({ session }: { session: Session }) {
  const { selection, log, player } = session;
  return (
    <div class="where">
      <label>
        Frame
        <input
          id="frame-number"
          type="number"
          min={0}
          max={log.number(log.frames - 1)}
          value={log.number(selection.frame.value)}
          onChange={(event) => player.goTo(log.withNumber(Number(event.currentTarget.value)))}
          onKeyDown={(event) => (event.key === "Escape" || event.key === "Enter") && event.currentTarget.blur()}
        />
        <span class="of">of {log.number(log.frames - 1) + 1}</span>
      </label>
      <output aria-label="Time">{timeText(selection.time_s.value)} s</output>
    </div>
  );
}

function Jumps({ session }: { session: Session }) {
  const { selection } = session;
  const jump = (label: string, stroke: string, onClick: () => void) => (
    <button type="button" class="text-button" title={`${label} (${stroke}; Shift ${stroke}: before)`} onClick={onClick}>
      <Icon name="jump" /> {label}
    </button>
  );
  return (
    <div class="jumps" role="group" aria-label="Jumps and span">
      {jump("Event", "E", () => jumpToEvent(session, 1))}
      {jump("Wrong", "W", () => jumpToVerdict(session, "wrong", 1))}
      {jump("Refused", "R", () => jumpToVerdict(session, "refused", 1))}
      <span class="divider" />
      <button type="button" class="text-button" title="Span begins at the cursor ([)" onClick={() => markSpan(session, "from_s")}>
        [ Begin
      </button>
      <button type="button" class="text-button" title="Span ends at the cursor (])" onClick={() => markSpan(session, "to_s")}>
        End ]
      </button>
      <IconButton icon="loop" label="Loop the span" stroke="\" pressed={selection.loop.value} onClick={() => toggleLoop(session)} />
    </div>
  );
}

function Key() {
  return (
    <ul class="key" aria-label="Colours of the time line">
      <li>
        <i class="swatch swatch-valid" /> valid
      </li>
      <li>
        <i class="swatch swatch-refused" /> refused
      </li>
      <li>
        <i class="swatch swatch-wrong" /> wrong
      </li>
    </ul>
  );
}

export function TimelineView() {
  const session = useSession();
  return (
    <section class="timeline" aria-label="Time line" data-view="timeline">
      <div class="timeline-tools">
        <Transport session={session} />
        <Where session={session} />
        <Jumps session={session} />
        <Key />
      </div>
      <Track session={session} />
    </section>
  );
}
