// The events in a long list: filtered by the server, drawn as far as they are in sight, and the frame's own are marked.
import { type Signal, useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import type { LogEvent } from "../../api/types.ts";
import { tell } from "../../app/notices.ts";
import { type Session, useSession } from "../../app/session.ts";
import { timeText } from "../../maths/scales.ts";
import { Empty, Panel } from "../../parts/controls.tsx";
import { Icon } from "../../parts/icon.tsx";
import { textScale } from "../../parts/rem.ts";
import { PAGE, pagesOf, ROW_REM, rowAfterKey, visibleRows } from "./rows.ts";

const LEVELS = [
  { id: "", label: "All levels" },
  { id: "warning", label: "Warnings and errors" },
  { id: "error", label: "Errors" },
];
const ICONS = { info: "info", warning: "warning", error: "error" } as const;
const FILTER_MS = 150;

interface Listing {
  total: number;
  rows: Map<number, LogEvent>;
}

/** The filtered events: pages are asked for as they come into sight. */
function useListing(session: Session, level: Signal<string>, first: number, last: number) {
  const listing = useSignal<Listing | null>(null);
  const filter = session.eventFilter.value;
  const asked = useRef(new Set<number>());
  const ask = (page: number, signal?: AbortSignal) => {
    asked.current.add(page);
    return session.log.events({ from: page * PAGE, count: PAGE, filter, level: level.value }, signal);
  };
  const take = (page: number, answer: { total: number; events: LogEvent[] }, anew: boolean) => {
    const rows = new Map(anew ? [] : listing.peek()?.rows);
    for (const [i, event] of answer.events.entries()) rows.set(page * PAGE + i, event);
    listing.value = { total: answer.total, rows };
  };
  useEffect(() => {
    const abort = new AbortController();
    const timer = setTimeout(() => {
      asked.current.clear();
      ask(0, abort.signal).then((answer) => take(0, answer, true), tell);
    }, FILTER_MS);
    return () => {
      clearTimeout(timer);
      abort.abort();
    };
  }, [session, filter, level.value, session.events.grown.value]);
  useEffect(() => {
    if (listing.peek() === null) return;
    for (const page of pagesOf({ first, last })) if (!asked.current.has(page)) ask(page).then((answer) => take(page, answer, false), tell);
  }, [first, last, listing.value?.total]);
  return listing;
}

function EventRow({
  event,
  row,
  frame,
  chosen,
  onChoose,
}: {
  event: LogEvent;
  row: number;
  frame: number;
  chosen: boolean;
  onChoose: () => void;
}) {
  const now = event.frame === frame ? " now" : "";
  return (
    <div
      id={`event-${row}`}
      role="option"
      tabIndex={-1}
      aria-selected={chosen}
      class={`event event-${event.level}${now}${chosen ? " chosen" : ""}`}
      style={{ top: `${row * ROW_REM}rem` }}
      onClick={onChoose}
      onKeyDown={() => undefined}
    >
      <span class="event-time">{timeText(event.time_s)} s</span>
      <span class="event-level" title={event.level}>
        <Icon name={ICONS[event.level] ?? "info"} />
        <span class="unseen">{event.level}</span>
      </span>
      <span class="event-name">{event.name}</span>
      <span class="event-text" title={event.text}>
        {event.text}
      </span>
    </div>
  );
}

function List({ session, level }: { session: Session; level: Signal<string> }) {
  const box = useRef<HTMLDivElement>(null);
  const scroll = useSignal(0);
  const chosen = useSignal(-1);
  const visible = visibleRows(scroll.value, box.current?.clientHeight ?? 400, rowPx(), Number.MAX_SAFE_INTEGER);
  const listing = useListing(session, level, visible.first, visible.last).value;
  if (listing === null) return <p class="hint">Reading the events …</p>;
  if (listing.total === 0)
    return session.eventFilter.value === "" && level.value === "" ? (
      <Empty title="This recording has no events.">The component had nothing to say.</Empty>
    ) : (
      <Empty title="No event fits.">Shorten the filter, or choose all levels.</Empty>
    );
  const choose = (row: number) => {
    chosen.value = row;
    const event = listing.rows.get(row);
    if (event !== undefined) session.player.goTo(event.frame);
    keepInSight(box.current, row);
  };
  const onKeyDown = (event: KeyboardEvent) => {
    const page = Math.max(1, Math.floor((box.current?.clientHeight ?? 0) / rowPx()));
    const row = rowAfterKey(event.key, chosen.peek(), listing.total, page);
    if (row === null || event.ctrlKey) return;
    event.preventDefault();
    choose(row);
  };
  const rows = [];
  for (let row = visible.first; row < Math.min(visible.last, listing.total); ++row) {
    const event = listing.rows.get(row);
    if (event !== undefined)
      rows.push(
        <EventRow
          key={row}
          event={event}
          row={row}
          frame={session.selection.frame.value}
          chosen={row === chosen.value}
          onChoose={() => choose(row)}
        />,
      );
  }
  const whole = listing.rows.get(chosen.value);
  return (
    <div class="event-box">
      <div
        ref={box}
        class="event-list"
        role="listbox"
        tabIndex={0}
        aria-label={`${listing.total} events`}
        aria-activedescendant={chosen.value >= 0 ? `event-${chosen.value}` : undefined}
        onKeyDown={onKeyDown}
        onScroll={(event) => {
          scroll.value = event.currentTarget.scrollTop;
        }}
      >
        <div class="event-space" role="presentation" style={{ height: `${listing.total * ROW_REM}rem` }}>
          {rows}
        </div>
      </div>
      {whole === undefined ? null : (
        <p class="event-whole" role="status">
          <b>{whole.name}</b> {whole.text}
        </p>
      )}
    </div>
  );
}

const rowPx = (): number => 13 * ROW_REM * textScale();

function keepInSight(box: HTMLElement | null, row: number): void {
  if (box === null) return;
  const height = rowPx();
  if (row * height < box.scrollTop) box.scrollTop = row * height;
  else if ((row + 1) * height > box.scrollTop + box.clientHeight) box.scrollTop = (row + 1) * height - box.clientHeight;
}

export function EventsView() {
  const session = useSession();
  const level = useSignal("");
  const tools = (
    <>
      <input
        id="event-filter"
        type="search"
        placeholder="Filter (/)"
        aria-label="Filter events by text"
        value={session.eventFilter.value}
        onInput={(event) => {
          session.eventFilter.value = event.currentTarget.value;
        }}
        onKeyDown={(event) => event.key === "Escape" && event.currentTarget.blur()}
      />
      <select
        aria-label="Level of events"
        value={level.value}
        onChange={(event) => {
          level.value = event.currentTarget.value;
        }}
      >
        {LEVELS.map(({ id, label }) => (
          <option key={id} value={id}>
            {label}
          </option>
        ))}
      </select>
    </>
  );
  return (
    <Panel id="events" title="Events" tools={tools}>
      <List session={session} level={level} />
    </Panel>
  );
}
