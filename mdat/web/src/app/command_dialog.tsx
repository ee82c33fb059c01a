// The command line's way to what the page shows.
import type { LiveState } from "../api/types.ts";
import { live } from "../live/feed.ts";
import { CommandText } from "../parts/controls.tsx";
import { Dialog } from "../parts/dialog.tsx";
import { useSession } from "./session.ts";

/** Of a run that this server has flown, or a component that it was connected to. */
function LiveCommand({ state }: { state: LiveState }) {
  return (
    <>
      <dt>{state.address === null ? "This run, flown live and recorded" : "This connection, watched and recorded"}</dt>
      <dd>
        <CommandText text={state.command} label="command of the live run" />
      </dd>
    </>
  );
}

export function CommandDialog() {
  const { log, selection } = useSession();
  const { info } = log;
  const file = info.file ?? info.name;
  const span = selection.span.value ?? selection.window.value;
  const times = `--from ${span.from_s.toFixed(3)} --to ${span.to_s.toFixed(3)}`;
  return (
    <Dialog title="The same from the command line">
      <dl class="commands">
        {live.value?.id === info.id ? <LiveCommand state={live.value} /> : null}
        <dt>Fly the recorded scans again and compare the telemetry</dt>
        <dd>
          <CommandText text={info.command} label="command of the replay" />
        </dd>
        <dt>What is in the file, and what is damaged</dt>
        <dd>
          <CommandText text={`mdat recording info ${file}`} label="command of the file's contents" />
        </dd>
        <dt>The numbers of the span that is marked, or shown, as tables</dt>
        <dd>
          <CommandText text={`mdat recording export ${file} --format csv ${times} --out tables`} label="command of the tables" />
        </dd>
        <dt>That span as a recording of its own</dt>
        <dd>
          <CommandText text={`mdat recording cut ${file} ${times} --out span.mcap`} label="command of the cut" />
        </dd>
        <dt>This page</dt>
        <dd>
          <CommandText text={`mdat serve ${file}`} label="command of this page" />
        </dd>
      </dl>
      <p class="hint">With --set KEY=VALUE the replay flies the same scans with a changed mission.</p>
    </Dialog>
  );
}
