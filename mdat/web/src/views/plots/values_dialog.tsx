// The choice of a value to plot: filtered as one types, in groups, by keyboard or pointer.
import { useSignal } from "@preact/signals";
import { useLayoutEffect, useRef } from "preact/hooks";
import type { ValueInfo } from "../../api/types.ts";
import { shortLabel } from "../../api/units.ts";
import { overlay } from "../../app/overlay.ts";
import { useSession } from "../../app/session.ts";
import { Empty } from "../../parts/controls.tsx";
import { Dialog } from "../../parts/dialog.tsx";

/** Values whose label, id, group or topic hold every word. */
export function fittingValues(values: ValueInfo[], text: string): ValueInfo[] {
  const words = text.toLowerCase().split(/\s+/).filter(Boolean);
  return values.filter((value) => {
    const where = `${value.label} ${value.id} ${value.group} ${value.topic} ${value.unit}`.toLowerCase();
    return words.every((word) => where.includes(word));
  });
}

export function ValuesDialog() {
  const { plots, log, history } = useSession();
  const text = useSignal("");
  const input = useRef<HTMLInputElement>(null);
  const target = plots.plots.value.find((plot) => plot.key === plots.addTo.value);
  const unit = target === undefined ? null : (plots.value(target.values[0])?.unit ?? "");
  const offered = log.info.values.filter((value) => unit === null || value.unit === unit);
  const found = fittingValues(offered, text.value);
  useLayoutEffect(() => input.current?.focus(), []);
  const choose = (value: ValueInfo) => {
    history.run(plots.add(value.id));
    overlay.value = null;
  };
  return (
    <Dialog title={unit === null ? "Plot a value" : `Add a value in ${unit || "the same unit"} to the plot`}>
      <input
        ref={input}
        type="search"
        class="wide"
        placeholder="Type a part of its name; Enter takes the first"
        aria-label="Filter values"
        value={text.value}
        onInput={(event) => {
          text.value = event.currentTarget.value;
        }}
        onKeyDown={(event) => event.key === "Enter" && found.length > 0 && choose(found[0])}
      />
      {found.length === 0 ? <Empty title="No value fits.">Shorten the filter.</Empty> : null}
      {[...new Set(found.map((value) => value.group))].map((group) => (
        <section key={group} class="value-group" aria-label={group}>
          <h3>{group}</h3>
          {found
            .filter((value) => value.group === group)
            .map((value) => (
              <button key={value.id} type="button" class="value" onClick={() => choose(value)}>
                <span class="value-name">
                  {shortLabel(value.label)}
                  {value.unit === "" ? "" : `, ${value.unit}`}
                </span>
                <span class="value-meaning">{value.label.slice(shortLabel(value.label).length + 2)}</span>
                <code>{value.topic}</code>
              </button>
            ))}
        </section>
      ))}
    </Dialog>
  );
}
