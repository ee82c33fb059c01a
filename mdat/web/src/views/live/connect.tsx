// On the start page: a component that runs elsewhere, to be watched and commanded by its link.
import { useSignal } from "@preact/signals";
import type { LiveMission } from "../../api/types.ts";
import { CommandText } from "../../parts/controls.tsx";
import { Icon } from "../../parts/icon.tsx";
import { isAddress, monitorCommandOf } from "./choice.ts";
import { MissionOptions } from "./mission_options.tsx";

const NONE = "";

export function Connect({ missions, onConnect }: { missions: LiveMission[]; onConnect: (address: string, mission: string) => void }) {
  const text = useSignal("");
  const mission = useSignal(NONE);
  const address = text.value.trim();
  const right = isAddress(address);
  const wrong = address !== "" && !right;
  const submit = (event: Event) => {
    event.preventDefault();
    if (right) onConnect(address, mission.value);
  };
  return (
    <form class="fly" aria-label="Connect to a component" onSubmit={submit}>
      <h3>Connect to a component</h3>
      <p class="hint">
        An emulated flight card, a board, or mdat run --link: its telemetry is shown as it comes, and recorded. A link carries no scans and
        no true poses.
      </p>
      <div class="fly-fields">
        <label>
          Address
          <input
            class="address"
            placeholder="udp://127.0.0.1:5300"
            spellcheck={false}
            autocomplete="off"
            value={text.value}
            aria-invalid={wrong}
            onInput={(event) => {
              text.value = event.currentTarget.value;
            }}
          />
        </label>
        <label>
          It flies
          <select
            value={mission.value}
            onChange={(event) => {
              mission.value = event.currentTarget.value;
            }}
          >
            <option value={NONE}>not known: no surface is shown</option>
            <MissionOptions missions={missions} />
          </select>
        </label>
        <button type="submit" class="primary" disabled={!right}>
          <Icon name="play" /> Connect
        </button>
      </div>
      {wrong ? (
        <p role="alert">An address is udp://HOST:PORT, tcp://HOST:PORT or serial:/dev/NAME. HOST is a number, such as 127.0.0.1.</p>
      ) : null}
      {right ? (
        <div>
          <p class="same">The same from the command line:</p>
          <CommandText
            text={monitorCommandOf(
              address,
              missions.find((each) => each.id === mission.value),
            )}
            label="command of the connection"
          />
        </div>
      ) : null}
    </form>
  );
}
