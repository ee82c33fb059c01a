// The name of a table that is added or copied.
import { useSignal } from "@preact/signals";
import type { Mission } from "../../design/mission.ts";
import { namedTables, namesIn } from "../../design/schema.ts";
import { freeName, nameProblem, withCopy, withTable } from "../../design/tables.ts";
import { Dialog } from "../../parts/dialog.tsx";

/** A copy of table.name; a new one, of a table that is chosen, where there is no name. */
export interface TableWish {
  table: string;
  name: string | null;
}

function changedText(mission: Mission, table: string, from: string | null, name: string): string {
  const text = mission.text.peek();
  if (from !== null) return withCopy(text, table, from, name);
  return withTable(text, table, name, namedTables(mission.schema).find((each) => each.table === table)!.schema);
}

function TableChoice({ mission, table, onChoose }: { mission: Mission; table: string; onChoose: (table: string) => void }) {
  return (
    <label>
      <span>Table</span>
      <select value={table} onChange={(event) => onChoose(event.currentTarget.value)}>
        {namedTables(mission.schema).map((each) => (
          <option key={each.table}>{each.table}</option>
        ))}
      </select>
    </label>
  );
}

export function TableDialog({ mission, wish, onClose }: { mission: Mission; wish: TableWish; onClose: () => void }) {
  const table = useSignal(wish.table);
  const taken = namesIn(table.value, mission.text.value, mission.values.value);
  const name = useSignal(wish.name === null ? "" : freeName(wish.name, taken));
  const problem = nameProblem(name.value, taken);
  const title = wish.name === null ? "Add a table" : `Copy ${wish.table}.${wish.name}`;
  const submit = (event: Event) => {
    event.preventDefault();
    if (problem !== "") return;
    const path = `${table.value}.${name.value}`;
    mission.rewrite(wish.name === null ? `adding ${path}` : `copying to ${path}`, changedText(mission, table.value, wish.name, name.value));
    mission.filter.value = "";
    mission.section.value = path;
    mission.showHeader(path);
    onClose();
  };
  return (
    <Dialog title={title} onClose={onClose}>
      <form class="mesh-form" onSubmit={submit}>
        {wish.name === null ? (
          <TableChoice
            mission={mission}
            table={table.value}
            onChoose={(next) => {
              table.value = next;
            }}
          />
        ) : null}
        <label>
          <span>Name</span>
          <input
            value={name.value}
            spellcheck={false}
            aria-invalid={name.value !== "" && problem !== ""}
            onInput={(event) => {
              name.value = event.currentTarget.value;
            }}
          />
          <small role="status">{name.value === "" ? "letters, digits, _ and -" : problem}</small>
        </label>
        <button type="submit" class="primary" disabled={problem !== ""}>
          {wish.name === null ? "Add" : "Copy"}
        </button>
      </form>
    </Dialog>
  );
}
