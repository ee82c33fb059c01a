// The editor of missions: tables of keys at the left, the form of one in the middle, the text that it is made of at the right.
import { useSignal } from "@preact/signals";
import type { ComponentChildren } from "preact";
import { useEffect, useLayoutEffect } from "preact/hooks";
import { CommonTools } from "../../app/common_tools.tsx";
import { remark } from "../../app/notices.ts";
import { remembered } from "../../app/remembered.ts";
import { routeTo, routeToMission } from "../../app/route.ts";
import { mission as current, type Mission } from "../../design/mission.ts";
import { hasRanges, rangeRows } from "../../design/ranges.ts";
import { fieldsOf, fittingFields, type Section } from "../../design/schema.ts";
import { hasTable, withoutTable } from "../../design/tables.ts";
import { CommandText, Empty, IconButton, Panel } from "../../parts/controls.tsx";
import { Icon } from "../../parts/icon.tsx";
import { shellWord } from "../../parts/shell_word.ts";
import { setFirstMission } from "../live/choice.ts";
import { Begun } from "./begun.tsx";
import { FieldRow } from "./field.tsx";
import { PreviewPane } from "./preview_pane.tsx";
import { RangeAxisFigure } from "./range_axis.tsx";
import { SaveDialog } from "./save_dialog.tsx";
import { TableDialog, type TableWish } from "./table_dialog.tsx";
import { TextPane } from "./text_pane.tsx";

/** Whether the preview is shown. */
const previewed = remembered("design-preview", true);

function hasProblem(mission: Mission, section: Section): boolean {
  return mission.problems.value.some(({ key }) => key === section.path || key.startsWith(`${section.path}.`));
}

/** A long name goes on in a further line where its words end. */
function breakable(path: string): ComponentChildren[] {
  return path.split(/(?<=[._])/).flatMap((word) => [word, <wbr key={word} />]);
}

type Ask = (wish: TableWish) => void;

function Sections({ mission, onAsk }: { mission: Mission; onAsk: Ask }) {
  const add = <IconButton icon="add" label="Add a table" onClick={() => onAsk({ table: "scenario", name: null })} />;
  return (
    <Panel id="sections" title="Tables" tools={mission.shipped ? null : add}>
      <nav class="scroll sections" aria-label="Tables of the mission">
        {mission.sections.value.map((section) => (
          <button
            key={section.path}
            type="button"
            aria-current={section.path === mission.section.value ? "true" : undefined}
            onClick={() => {
              mission.filter.value = "";
              mission.section.value = section.path;
            }}
          >
            <span class={section.depth ? `node-depth-${Math.min(3, section.depth)}` : ""}>{breakable(section.path)}</span>
            {hasProblem(mission, section) ? <Icon name="error" /> : null}
          </button>
        ))}
      </nav>
    </Panel>
  );
}

/** Of a table with a chosen name, and headers of its own in the text. */
function TableTools({ mission, onAsk }: { mission: Mission; onAsk: Ask }) {
  const [table, name] = mission.section.value.split(".");
  if (name === undefined || mission.shipped || !hasTable(mission.text.value, table, name)) return null;
  const remove = () => {
    mission.rewrite(`removing ${table}.${name}`, withoutTable(mission.text.peek(), table, name));
    mission.section.value = "scan";
    remark(`${table}.${name} is removed. Undo brings it back.`);
  };
  return (
    <>
      <IconButton icon="copy" label={`Copy ${table}.${name}`} onClick={() => onAsk({ table, name })} />
      <IconButton icon="remove" label={`Remove ${table}.${name}`} onClick={remove} />
    </>
  );
}

/** Of the table that is chosen; while the filter holds words, of all. */
function Form({ mission, onAsk }: { mission: Mission; onAsk: Ask }) {
  const words = mission.filter.value;
  const sections = mission.sections.value.filter((section) => words !== "" || section.path === mission.section.value);
  const fields = sections.flatMap((section) => fieldsOf(section, mission.byKey.value));
  const found = fittingFields(fields, words).map((field) => (words === "" ? field : { ...field, name: field.key }));
  return (
    <Panel
      id="form"
      title={words === "" ? mission.section.value : `${found.length} keys`}
      tools={
        <>
          {words === "" ? <TableTools mission={mission} onAsk={onAsk} /> : null}
          <input
            type="search"
            placeholder="Find a key (/)"
            aria-label="Find a key"
            id="key-filter"
            value={words}
            onInput={(event) => {
              mission.filter.value = event.currentTarget.value;
            }}
          />
        </>
      }
    >
      <div class="scroll">
        {words === "" && hasRanges(rangeRows(mission.byKey.value, mission.section.value), mission.section.value) ? (
          <RangeAxisFigure mission={mission} />
        ) : null}
        {found.length === 0 ? <Empty title="No key fits.">Change the words, or look into the text.</Empty> : null}
        {found.map((field) => (
          <FieldRow key={field.key} mission={mission} field={field} />
        ))}
      </div>
    </Panel>
  );
}

function Problems({ mission }: { mission: Mission }) {
  const problems = mission.problems.value;
  if (problems.length === 0) {
    const warnings = mission.warnings.value;
    return warnings.length === 0 ? null : (
      <details class="banner">
        <summary>
          <Icon name="warning" /> {warnings.length === 1 ? "1 warning" : `${warnings.length} warnings`}
        </summary>
        <ul>
          {warnings.map((warning) => (
            <li key={warning}>{warning}</li>
          ))}
        </ul>
      </details>
    );
  }
  return (
    <div class="problems" role="alert">
      <strong>{problems.length === 1 ? "1 problem" : `${problems.length} problems`}; the form shows the last text without any</strong>
      <ul>
        {problems.map((problem) => (
          <li key={`${problem.line} ${problem.key} ${problem.expected}`}>
            <button
              type="button"
              class="link"
              onClick={() => {
                mission.line.value = problem.line;
              }}
            >
              {problem.line > 0 ? `line ${problem.line}` : "mission"}
            </button>{" "}
            {[problem.key, problem.value, problem.expected].filter(Boolean).join(": ")}
          </li>
        ))}
      </ul>
    </div>
  );
}

function commandOf(mission: Mission): string {
  const settings = mission.same.value ?? [];
  const words = settings.length === 0 ? ["mdat", "mission", "check", mission.file] : ["mdat", "mission", "set", mission.file, ...settings];
  return words.map(shellWord).join(" ");
}

/** What the command does, where it is not what the page has done. */
function commandRemark(mission: Mission): string {
  const { changed, same, problems } = mission;
  if (!changed.value || problems.value.length > 0 || (same.value ?? []).length > 0) return "";
  return same.value === null
    ? "Values are gone, or very many are new: no command does that. Save, then the file can be checked:"
    : "Comments and order are changed, and no value:";
}

/** A shipped mission is read: what is designed is a copy. */
function CopyForm({ mission }: { mission: Mission }) {
  const name = useSignal(`my_${mission.id.replace(/\W/g, "_")}`);
  const submit = async (event: Event) => {
    event.preventDefault();
    const id = await mission.copy(name.value.trim());
    if (id !== null) location.hash = routeToMission(id);
  };
  return (
    <form class="banner copy-form" aria-label="Copy the mission" onSubmit={submit}>
      <Icon name="info" /> A shipped mission is not changed. Make a copy of it, with all its files, to design on:
      <label>
        Folder{" "}
        <input
          value={name.value}
          onInput={(event) => {
            name.value = event.currentTarget.value;
          }}
        />
      </label>
      <button type="submit" class="text-button">
        <Icon name="copy" /> Copy
      </button>
    </form>
  );
}

function Head({ mission, onSave }: { mission: Mission; onSave: () => void }) {
  const { canUndo, canRedo } = mission.history;
  const savable = mission.changed.value && mission.problems.value.length === 0;
  return (
    <header class="head">
      <a class="brand" href={routeTo(null)}>
        <Icon name="home" />
        <span>MDAT</span>
      </a>
      <h1>{mission.id}</h1>
      <p class="run">{mission.shipped ? "shipped" : mission.changed.value ? "changed, not saved" : "saved"}</p>
      <div class="head-tools">
        <IconButton icon="undo" label="Undo" stroke="Ctrl+z" disabled={canUndo.value === null} onClick={() => mission.undo(false)} />
        <IconButton
          icon="redo"
          label="Do again"
          stroke="Ctrl+Shift+z"
          disabled={canRedo.value === null}
          onClick={() => mission.undo(true)}
        />
        <button
          type="button"
          class="text-button"
          title="Target and scan of the text, in 3D"
          aria-pressed={previewed.value}
          onClick={() => {
            previewed.value = !previewed.value;
          }}
        >
          <Icon name="layers" /> Preview
        </button>
        <button type="button" class="text-button" title="Save (Ctrl S)" disabled={!savable} onClick={onSave}>
          <Icon name="download" /> Save …
        </button>
        <a
          class="text-button"
          href={routeTo(null)}
          title={mission.changed.value ? "The saved mission is flown: save first what is to fly" : "Choose a scenario and fly it live"}
          onClick={() => setFirstMission(mission.id)}
        >
          <Icon name="play" /> Fly …
        </a>
        <CommonTools />
      </div>
    </header>
  );
}

/** What a stroke does outside of fields, and Ctrl S everywhere; null: nothing. */
function actOf(event: KeyboardEvent, mission: Mission, onSave: () => void): (() => void) | null {
  const key = event.key.toLowerCase();
  const control = event.ctrlKey || event.metaKey;
  if (control && key === "s") return onSave;
  if (["INPUT", "TEXTAREA", "SELECT"].includes((event.target as HTMLElement).tagName)) return null;
  if (control && (key === "z" || key === "y")) return () => mission.undo(key === "y" || event.shiftKey);
  return !control && key === "/" ? () => document.querySelector<HTMLElement>("#key-filter")?.focus() : null;
}

/** From the first picture on: a stroke that comes with it is not lost. */
function useKeys(mission: Mission, onSave: () => void): void {
  useLayoutEffect(() => {
    const onKey = (event: KeyboardEvent) => {
      const act = actOf(event, mission, onSave);
      if (act === null) return;
      event.preventDefault();
      act();
    };
    window.addEventListener("keydown", onKey);
    return () => window.removeEventListener("keydown", onKey);
  }, [mission]);
}

/** Leaving the page with changes that are not saved is asked about by the browser. */
function useGuard(mission: Mission): void {
  useEffect(() => {
    const ask = (event: BeforeUnloadEvent) => mission.changed.peek() && event.preventDefault();
    window.addEventListener("beforeunload", ask);
    return () => window.removeEventListener("beforeunload", ask);
  }, [mission]);
}

export function DesignView() {
  const mission = current.value!;
  const saving = useSignal(false);
  const wish = useSignal<TableWish | null>(null);
  const ask: Ask = (next) => {
    wish.value = next;
  };
  const save = async () => {
    await mission.pending;
    saving.value = mission.changed.peek() && mission.problems.peek().length === 0;
  };
  useKeys(mission, save);
  useGuard(mission);
  useEffect(() => {
    document.title = `${mission.id} – MDAT`;
  }, [mission]);
  return (
    <div class="workspace design" data-view="design">
      <Head mission={mission} onSave={save} />
      {mission.shipped ? <CopyForm mission={mission} /> : null}
      <Begun mission={mission} />
      <Problems mission={mission} />
      <main class="design-views">
        <Sections mission={mission} onAsk={ask} />
        <Form mission={mission} onAsk={ask} />
        <div class={`design-side${previewed.value ? " previewed" : ""}`}>
          {previewed.value ? <PreviewPane mission={mission} /> : null}
          <TextPane mission={mission} />
        </div>
      </main>
      <footer class="design-foot">
        {commandRemark(mission) === "" ? null : <p class="hint">{commandRemark(mission)}</p>}
        <CommandText text={commandOf(mission)} label="command of these changes" />
      </footer>
      {wish.value === null ? null : (
        <TableDialog
          mission={mission}
          wish={wish.value}
          onClose={() => {
            wish.value = null;
          }}
        />
      )}
      {saving.value ? (
        <SaveDialog
          mission={mission}
          onClose={() => {
            saving.value = false;
          }}
        />
      ) : null}
    </div>
  );
}
