// The mission's TOML, to be read and edited, with its lines numbered and those with problems marked.
import { useLayoutEffect, useRef } from "preact/hooks";
import type { Mission } from "../../design/mission.ts";
import { Panel } from "../../parts/controls.tsx";

const LINES_ABOVE = 5;

/** Selects a line and brings it into sight. */
function showLine(area: HTMLTextAreaElement, line: number): void {
  const lines = area.value.split("\n");
  const from = lines.slice(0, line - 1).reduce((sum, each) => sum + each.length + 1, 0);
  area.setSelectionRange(from, from + (lines[line - 1]?.length ?? 0));
  area.scrollTop = Math.max(0, ((line - LINES_ABOVE) * area.scrollHeight) / lines.length);
}

function Gutter({ mission }: { mission: Mission }) {
  const bad = new Set(mission.problems.value.map((problem) => problem.line));
  const count = mission.text.value.split("\n").length;
  return (
    <div class="gutter" aria-hidden="true">
      {Array.from({ length: count }, (_, i) => (
        <span key={i} class={bad.has(i + 1) ? "bad-line" : i + 1 === mission.line.value ? "shown-line" : ""}>
          {i + 1}
        </span>
      ))}
    </div>
  );
}

/** Indents by two, as missions do; everything else is the browser's. */
function onKeyDown(event: KeyboardEvent, mission: Mission): void {
  const control = event.ctrlKey || event.metaKey;
  const key = event.key.toLowerCase();
  if (!control || (key !== "z" && key !== "y")) return;
  event.preventDefault();
  event.stopPropagation();
  mission.undo(key === "y" || event.shiftKey);
}

export function TextPane({ mission }: { mission: Mission }) {
  const area = useRef<HTMLTextAreaElement>(null);
  const gutter = useRef<HTMLDivElement>(null);
  const line = mission.line.value;
  useLayoutEffect(() => {
    if (line > 0 && area.current !== null) showLine(area.current, line);
  }, [line]);
  const scroll = () => {
    if (gutter.current !== null && area.current !== null) gutter.current.scrollTop = area.current.scrollTop;
  };
  return (
    <Panel id="toml" title={mission.file.replace(/^.*\//, "")}>
      <div class="toml">
        <div ref={gutter} class="gutter-frame">
          <Gutter mission={mission} />
        </div>
        <textarea
          ref={area}
          aria-label="The mission's text"
          spellcheck={false}
          wrap="off"
          readOnly={mission.shipped}
          value={mission.text.value}
          onInput={(event) => mission.type(event.currentTarget.value)}
          onKeyDown={(event) => onKeyDown(event, mission)}
          onScroll={scroll}
        />
      </div>
    </Panel>
  );
}
