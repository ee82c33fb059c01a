// One opened recording and all that the views share of it.
import { type Signal, signal } from "@preact/signals";
import { createContext } from "preact";
import { useContext } from "preact/hooks";
import { isLive } from "../live/feed.ts";
import { Events } from "../log/events.ts";
import { Log } from "../log/log.ts";
import { Player } from "../log/player.ts";
import { Selection } from "../log/selection.ts";
import { PlotChoice } from "../views/plots/choice.ts";
import { SceneChoice } from "../views/scene3d/choice.ts";
import { History } from "./history.ts";
import { tell } from "./notices.ts";

const WAIT_MS = 150;

/** A run that has just begun has no frame yet: the first one is waited for. */
async function openedWithFrames(id: string): Promise<Log> {
  for (;;) {
    const log = await Log.open(id);
    if (log.frames > 0 || !isLive(id)) return log;
    await new Promise((resolve) => setTimeout(resolve, WAIT_MS));
  }
}

export class Session {
  readonly log: Log;
  readonly selection: Selection;
  readonly player: Player;
  readonly events = new Events();
  readonly history = new History();
  readonly plots: PlotChoice;
  readonly scene: SceneChoice;
  /** Text in the filter of the list of events. */
  readonly eventFilter: Signal<string> = signal("");

  constructor(log: Log) {
    this.log = log;
    this.selection = new Selection(log);
    this.player = new Player(this.selection);
    this.plots = new PlotChoice(log.info);
    this.scene = new SceneChoice(log.info);
  }

  static async open(id: string): Promise<Session> {
    const log = await openedWithFrames(id);
    log.live.value = isLive(id);
    const session = new Session(log);
    if (log.live.peek()) session.selection.setFrame(log.frames - 1);
    session.events.load(session.log).catch(tell);
    return session;
  }
}

/** The opened recording; null on the start page. */
export const session = signal<Session | null>(null);

export const SessionContext = createContext<Session | null>(null);

/** The session of the view that calls it. */
export function useSession(): Session {
  const found = useContext(SessionContext);
  if (found === null) throw new Error("a view without a recording");
  return found;
}
