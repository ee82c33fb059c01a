// One key of the form: its value with unit, what it means, what may stand there, and where its value came from.
import { useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import type { Mission } from "../../design/mission.ts";
import { expectedText, type Field, presetText } from "../../design/schema.ts";

/** Without the quotes of TOML. */
function shown(text: string): string {
  return /^".*"$/.test(text) ? text.slice(1, -1) : text;
}

/** A text that is no TOML by itself is quoted by the server; one that would be read as a number is quoted here. */
function written(text: string, field: Field): string {
  return field.schema.type === "string" ? JSON.stringify(text) : text;
}

interface EntryProps {
  field: Field;
  value: string;
  disabled: boolean;
  describedBy: string;
  invalid: boolean;
  onChoose: (value: string) => void;
}

function Choice({ field, value, disabled, describedBy, invalid, onChoose, options }: EntryProps & { options: string[] }) {
  return (
    <select
      id={`field-${field.key}`}
      value={value}
      disabled={disabled}
      aria-describedby={describedBy}
      aria-invalid={invalid}
      onChange={(event) => onChoose(event.currentTarget.value)}
    >
      {options.map((option) => (
        <option key={option} value={option}>
          {option}
        </option>
      ))}
    </select>
  );
}

/** What is typed becomes the value with Enter, or when the field is left. Escape takes it back. */
function Typed({ field, value, disabled, describedBy, invalid, onChoose }: EntryProps) {
  const typed = useSignal(value);
  const last = useRef(value);
  // What is being typed stays: a new value takes the place of the one before alone.
  useEffect(() => {
    if (typed.peek() === last.current) typed.value = value;
    last.current = value;
  }, [value]);
  const commit = () => typed.value.trim() !== value && onChoose(typed.value.trim());
  return (
    <input
      id={`field-${field.key}`}
      value={typed.value}
      disabled={disabled}
      aria-describedby={describedBy}
      aria-invalid={invalid}
      spellcheck={false}
      onInput={(event) => {
        typed.value = event.currentTarget.value;
      }}
      onBlur={commit}
      onKeyDown={(event) => {
        if (event.key === "Enter") commit();
        if (event.key === "Escape") typed.value = value;
      }}
    />
  );
}

function Entry(props: EntryProps) {
  const { schema } = props.field;
  if (schema.enum !== undefined) return <Choice {...props} options={schema.enum} />;
  if (schema.type === "boolean") return <Choice {...props} options={["true", "false"]} />;
  return <Typed {...props} />;
}

function placeText(place: string | undefined, preset: string): string {
  if (place === undefined) return preset === "" ? "not written" : "preset";
  return place;
}

export function FieldRow({ mission, field }: { mission: Mission; field: Field }) {
  const held = mission.byKey.value.get(field.key);
  const problems = mission.problems.value.filter((problem) => problem.key === field.key);
  const preset = presetText(field.schema);
  const value = shown(mission.settings.value.get(field.key) ?? held?.value ?? preset);
  // A file is shown by its name, but written with its folder: the text has it.
  const isFile = field.schema.type === "string" && held !== undefined && !held.value.startsWith('"');
  const changed = mission.settings.value.has(field.key);
  const unit = field.schema["x-unit"] ?? "";
  const help = `help-${field.key}`;
  return (
    <div class={`field-row${held !== undefined && held.line > 0 ? " written" : ""}`}>
      <label for={`field-${field.key}`}>
        {field.name}
        {changed ? <span class="changed"> changed</span> : null}
      </label>
      <span class="field-value">
        <Entry
          field={field}
          value={value}
          disabled={isFile || field.schema.const !== undefined}
          describedBy={help}
          invalid={problems.length > 0}
          onChoose={(next) => mission.set(field.key, written(next, field))}
        />
        <span class="unit">{unit}</span>
      </span>
      {held !== undefined && held.line > 0 ? (
        <button
          type="button"
          class="link place"
          title={held.place}
          onClick={() => {
            mission.line.value = held.line;
          }}
        >
          line {held.line}
        </button>
      ) : (
        <span class="place">{placeText(held?.place, preset)}</span>
      )}
      <p id={help} class="field-help">
        {field.schema.description ?? ""}
        <span class="expected">
          {field.schema.description === undefined ? "" : " · "}
          {expectedText(field.schema)}
          {preset === "" ? "" : `; preset ${shown(preset)}`}
          {isFile ? "; files are changed in the text" : ""}
        </span>
      </p>
      {problems.map((problem) => (
        <p key={problem.expected} class="bad" role="alert">
          {problem.value === "" ? "" : `${problem.value}: `}
          {problem.expected}
        </p>
      ))}
    </div>
  );
}
