// All keys, from the same list that the keyboard's handler reads.
import { Keys } from "../parts/controls.tsx";
import { Dialog } from "../parts/dialog.tsx";
import { ACTIONS, type Action } from "./actions.ts";

const GROUPS: Action["group"][] = ["Play", "Find", "Span and zoom", "3D", "Page"];

export function KeysDialog() {
  return (
    <Dialog title="Keys">
      <div class="key-groups">
        {GROUPS.map((group) => (
          <section key={group} aria-label={group}>
            <h3>{group}</h3>
            <dl>
              {ACTIONS.filter((action) => action.group === group).map((action) => (
                <div key={action.keys[0]}>
                  <dt>
                    <Keys stroke={action.keys[0]} />
                  </dt>
                  <dd>{action.label}</dd>
                </div>
              ))}
            </dl>
          </section>
        ))}
      </div>
      <p class="hint">
        With the pointer: drag in a plot or on the time line to mark a span, wheel to zoom, Shift and drag to move, double click to show
        all. In the 3D view drag to turn, wheel to go nearer, right button to move.
      </p>
      <p class="hint">
        <a href="/licences.txt" target="_blank" rel="noreferrer">
          Licences of the libraries in this page
        </a>
      </p>
    </Dialog>
  );
}
