// Commands to the component that is connected, as forms made from the dictionary: with verification, and arm and fire.
import { type Signal, useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { getJson } from "../../api/client.ts";
import type { CommandInfo, CommandItem, CommandList, CommandRecord, LiveState } from "../../api/types.ts";
import { tell } from "../../app/notices.ts";
import { giveCommand, live } from "../../live/feed.ts";
import { CommandText } from "../../parts/controls.tsx";
import { Dialog } from "../../parts/dialog.tsx";
import { Icon } from "../../parts/icon.tsx";
import { ARMED_S, armedBy, commandLine, faultOf, hintOf, isAbout, isForForms, phaseText, unitOf, valuesOf } from "./form.ts";

const LOOK_MS = 250;
const FIRST = "set_mode";

/** When each arming was first seen as executed, on the page's clock. */
const armed_ms = new Map<number, number>();

/** Seconds that are left of arm and fire; 0: it is not armed. */
function useArmed(state: LiveState, command: CommandInfo): number {
  const left = useSignal(0);
  const record = command.hazardous ? armedBy(state.commands, command.name) : null;
  useEffect(() => {
    if (record === null) {
      left.value = 0;
      return undefined;
    }
    if (!armed_ms.has(record.number)) armed_ms.set(record.number, performance.now());
    const look = () => {
      left.value = Math.max(0, ARMED_S - (performance.now() - (armed_ms.get(record.number) ?? 0)) / 1000);
    };
    look();
    const timer = setInterval(look, LOOK_MS);
    return () => clearInterval(timer);
  }, [record?.number]);
  return left.value;
}

interface FieldProps {
  item: CommandItem;
  choices: CommandList["enumerations"][string] | undefined;
  text: string;
  onText: (text: string) => void;
}

function Field({ item, choices, text, onText }: FieldProps) {
  const fault = text === "" ? null : faultOf(item, text);
  const help = `order-help-${item.name}`;
  const field = `order-${item.name}`;
  return (
    <div class="order-field">
      <span class="order-name">
        <label for={field}>{item.name}</label>
        {unitOf(item) === "" ? null : <span class="unit">{unitOf(item)}</span>}
      </span>
      {choices !== undefined && item.count === 1 ? (
        <select id={field} value={text} aria-describedby={help} onChange={(event) => onText(event.currentTarget.value)}>
          <option value="">choose …</option>
          {choices.map(({ name, meaning }) => (
            <option key={name} value={name}>
              {meaning === "" ? name : `${name}: ${meaning}`}
            </option>
          ))}
        </select>
      ) : (
        <input
          id={field}
          value={text}
          spellcheck={false}
          autocomplete="off"
          placeholder={hintOf(item)}
          aria-describedby={help}
          aria-invalid={fault !== null}
          onInput={(event) => onText(event.currentTarget.value)}
        />
      )}
      <small id={help} class={fault === null ? "" : "bad"}>
        {fault ?? item.meaning}
      </small>
    </div>
  );
}

function Buttons({
  state,
  command,
  values,
  ready,
}: {
  state: LiveState;
  command: CommandInfo;
  values: Record<string, string>;
  ready: boolean;
}) {
  const left = useArmed(state, command);
  const may = state.may_command && ready;
  if (!command.hazardous)
    return (
      <button type="submit" class="primary" disabled={!may}>
        <Icon name="play" /> Send
      </button>
    );
  return (
    <>
      <button
        type="button"
        class="text-button"
        disabled={!may || left > 0}
        onClick={() => giveCommand({ name: command.name, values: {}, arm: true })}
      >
        1. Arm
      </button>
      <button
        type="button"
        class="primary danger"
        disabled={!may || left === 0}
        onClick={() => giveCommand({ name: command.name, values })}
      >
        <Icon name="warning" /> 2. Fire
      </button>
      <span role="status">{left > 0 ? `Armed: ${Math.ceil(left)} s left to fire.` : "Hazardous: arm it, then fire within 10 s."}</span>
    </>
  );
}

function OrderForm({ state, command, list }: { state: LiveState; command: CommandInfo; list: CommandList }) {
  const texts = useSignal<Record<string, string>>({});
  const ready = command.items.every((item) => faultOf(item, texts.value[item.name] ?? "") === null);
  const values = valuesOf(command, texts.value);
  const submit = (event: Event) => {
    event.preventDefault();
    if (ready && state.may_command && !command.hazardous) giveCommand({ name: command.name, values });
  };
  return (
    <form class="order-form" aria-label={command.name} onSubmit={submit}>
      <h3>
        <code>{command.name}</code>
      </h3>
      <p>{command.meaning}</p>
      {command.items.map((item) => (
        <Field
          key={item.name}
          item={item}
          choices={item.enumeration === undefined ? undefined : list.enumerations[item.enumeration]}
          text={texts.value[item.name] ?? ""}
          onText={(text) => {
            texts.value = { ...texts.value, [item.name]: text };
          }}
        />
      ))}
      <div class="order-buttons">
        <Buttons state={state} command={command} values={values} ready={ready} />
      </div>
      {state.may_command ? null : (
        <p class="order-refused" role="note">
          <Icon name="info" /> Commands are not allowed from this page. Start it with <code>mdat serve --allow-commands</code>, or use the
          command line below.
        </p>
      )}
      <CommandText text={commandLine(command, values, state.address ?? "")} label="command line of the command" />
    </form>
  );
}

const DONE: CommandRecord["phase"][] = ["executed"];
const BAD: CommandRecord["phase"][] = ["failed", "refused", "unanswered", "not_sent"];

function Records({ records }: { records: CommandRecord[] }) {
  if (records.length === 0) return <p class="hint">None yet.</p>;
  return (
    <ol class="orders" reversed aria-label="Commands that were given" aria-live="polite">
      {[...records].reverse().map((record) => (
        <li key={record.number} class={BAD.includes(record.phase) ? "bad" : DONE.includes(record.phase) ? "good" : ""}>
          <Icon name={BAD.includes(record.phase) ? "error" : DONE.includes(record.phase) ? "check" : "info"} />
          <span>
            <code>{record.arm ? `arm ${record.name}` : record.name}</code>
            {Object.entries(record.values).map(([name, value]) => ` ${name}=${value}`)} — {phaseText(record)}
          </span>
        </li>
      ))}
    </ol>
  );
}

interface CommandChoiceProps {
  commands: CommandInfo[];
  enumerations: CommandList["enumerations"];
  chosen: Signal<string>;
}

function CommandChoice({ commands, enumerations, chosen }: CommandChoiceProps) {
  const filter = useSignal("");
  const shown = commands.filter((command) => isAbout(command, enumerations, filter.value));
  return (
    <div class="order-choice">
      <input
        type="search"
        aria-label="Filter commands"
        placeholder="Filter commands"
        value={filter.value}
        onInput={(event) => {
          filter.value = event.currentTarget.value;
        }}
      />
      <div class="order-names" role="group" aria-label="Commands">
        {shown.map(({ name, meaning, hazardous }) => (
          <button
            key={name}
            type="button"
            class="value"
            title={hazardous ? `${meaning} (hazardous: arm it first)` : meaning}
            aria-pressed={chosen.value === name}
            onClick={() => {
              chosen.value = name;
            }}
          >
            <code>{name}</code> {hazardous ? <Icon name="warning" /> : null}
          </button>
        ))}
        {shown.length === 0 ? <p class="hint">No command has “{filter.value}”.</p> : null}
      </div>
    </div>
  );
}

export function OrdersDialog() {
  const list = useSignal<CommandList | null>(null);
  const chosen = useSignal(FIRST);
  useEffect(() => {
    getJson<CommandList>("/api/live/commands").then((answer) => (list.value = answer), tell);
  }, []);
  const state = live.value;
  if (list.value === null || state === null || state.address === null) return null;
  const commands = list.value.commands.filter(isForForms);
  const command = commands.find(({ name }) => name === chosen.value) ?? commands[0];
  return (
    <Dialog title={`Commands to ${state.address}`}>
      <div class="order-columns">
        <CommandChoice commands={commands} enumerations={list.value.enumerations} chosen={chosen} />
        <div>
          <OrderForm key={command.name} state={state} command={command} list={list.value} />
          <h3>Commands sent</h3>
          <Records records={state.commands} />
        </div>
      </div>
    </Dialog>
  );
}
