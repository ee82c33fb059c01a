// What the keyboard does, as a list: the handler of keys and the page of help both read it.
import { changePace, live, stepRun, toggleRun } from "../live/feed.ts";
import { nextIndex, verdictOf } from "../log/frames.ts";
import { CAMERAS, COLOURS } from "../views/scene3d/choice.ts";
import { setting } from "./history.ts";
import { remark } from "./notices.ts";
import { openOverlay, overlay } from "./overlay.ts";
import type { Session } from "./session.ts";
import { toggleTheme } from "./theme.ts";

export interface Action {
  keys: string[];
  label: string;
  group: "Play" | "Find" | "Span and zoom" | "3D" | "Page";
  run: (session: Session) => void;
}

/** Goes to the next frame with that verdict, or says that there is none. */
export function jumpToVerdict(session: Session, verdict: "refused" | "wrong", direction: 1 | -1): void {
  const { valid, wrong } = session.log.columns;
  const from = session.selection.frame.peek();
  const found = nextIndex(session.log.frames, from, direction, (i) => verdictOf(valid[i], wrong[i]) === verdict);
  if (found >= 0) session.player.goTo(found);
  else remark(`No ${verdict} pose ${direction === 1 ? "after" : "before"} frame ${session.log.number(from)}.`);
}

export function jumpToEvent(session: Session, direction: 1 | -1): void {
  const from = session.selection.frame.peek();
  const event = session.events.next(from, direction);
  if (event !== null) session.player.goTo(event.frame);
  else remark(`No event ${direction === 1 ? "after" : "before"} frame ${session.log.number(from)}.`);
}

/** Begins or ends the span at the cursor; the other end stays, or is the recording's. */
export function markSpan(session: Session, end: "from_s" | "to_s"): void {
  const { selection, history } = session;
  const time_s = selection.time_s.peek();
  const old = selection.span.peek() ?? selection.whole;
  const other = end === "from_s" ? Math.max(old.to_s, time_s) : Math.min(old.from_s, time_s);
  const span = end === "from_s" ? { from_s: time_s, to_s: other } : { from_s: other, to_s: time_s };
  history.run(setting("the span", selection.span, span));
}

export function toggleLoop(session: Session): void {
  const { selection } = session;
  if (selection.span.peek() === null) selection.setSpan(selection.window.peek());
  selection.loop.value = !selection.loop.peek();
}

function undo(session: Session, redo: boolean): void {
  const command = redo ? session.history.redo() : session.history.undo();
  remark(command === null ? `Nothing to ${redo ? "do again" : "undo"}.` : `${redo ? "Done again" : "Undone"}: ${command.label}.`);
}

function nextColour(session: Session): void {
  const { colour } = session.scene;
  const at = COLOURS.findIndex((each) => each.id === colour.peek());
  session.history.run(setting("colour of points", colour, COLOURS[(at + 1) % COLOURS.length].id));
}

function focusOn(selector: string): void {
  document.querySelector<HTMLElement>(selector)?.focus();
}

/** At the newest frame of a live run the keys are the run's. */
export function playOrPause(session: Session): void {
  if (session.selection.following.peek()) toggleRun();
  else session.player.toggle();
}

export function stepForward(session: Session): void {
  if (session.selection.following.peek() && live.peek()?.paused === true) stepRun();
  else session.player.step(1);
}

function changeSpeed(session: Session, steps: 1 | -1): void {
  if (session.selection.following.peek()) changePace(steps);
  else session.player.changeSpeed(steps);
}

const play: Action[] = [
  { keys: ["Space"], label: "play or pause; at the newest frame of a live run: the run", group: "Play", run: playOrPause },
  { keys: ["ArrowRight"], label: "next frame; of a paused run it is flown", group: "Play", run: stepForward },
  { keys: ["ArrowLeft"], label: "frame before", group: "Play", run: (s) => s.player.step(-1) },
  { keys: ["Shift+ArrowRight"], label: "ten frames on", group: "Play", run: (s) => s.player.step(10) },
  { keys: ["Shift+ArrowLeft"], label: "ten frames back", group: "Play", run: (s) => s.player.step(-10) },
  { keys: ["j"], label: "play in reverse; again: faster", group: "Play", run: (s) => s.player.shuttle(-1) },
  { keys: ["k"], label: "pause", group: "Play", run: (s) => s.player.pause() },
  { keys: ["l"], label: "play; again: faster", group: "Play", run: (s) => s.player.shuttle(1) },
  { keys: [","], label: "slower, also a live run", group: "Play", run: (s) => changeSpeed(s, -1) },
  { keys: ["."], label: "faster, also a live run", group: "Play", run: (s) => changeSpeed(s, 1) },
  { keys: ["Home"], label: "first frame", group: "Play", run: (s) => s.player.goTo(0) },
  { keys: ["End"], label: "last frame; of a live run: follow it", group: "Play", run: (s) => s.player.goTo(s.log.frames - 1) },
];

const find: Action[] = [
  { keys: ["e"], label: "next event", group: "Find", run: (s) => jumpToEvent(s, 1) },
  { keys: ["Shift+e"], label: "event before", group: "Find", run: (s) => jumpToEvent(s, -1) },
  { keys: ["w"], label: "next wrong pose", group: "Find", run: (s) => jumpToVerdict(s, "wrong", 1) },
  { keys: ["Shift+w"], label: "wrong pose before", group: "Find", run: (s) => jumpToVerdict(s, "wrong", -1) },
  { keys: ["r"], label: "next refused pose", group: "Find", run: (s) => jumpToVerdict(s, "refused", 1) },
  { keys: ["Shift+r"], label: "refused pose before", group: "Find", run: (s) => jumpToVerdict(s, "refused", -1) },
  { keys: ["g"], label: "go to a frame by its number", group: "Find", run: () => focusOn("#frame-number") },
  { keys: ["/"], label: "filter events", group: "Find", run: () => focusOn("#event-filter") },
];

const span: Action[] = [
  { keys: ["["], label: "span begins at the cursor", group: "Span and zoom", run: (s) => markSpan(s, "from_s") },
  { keys: ["]"], label: "span ends at the cursor", group: "Span and zoom", run: (s) => markSpan(s, "to_s") },
  { keys: ["\\"], label: "loop the span", group: "Span and zoom", run: (s) => toggleLoop(s) },
  {
    keys: ["+", "="],
    label: "zoom in on the cursor",
    group: "Span and zoom",
    run: (s) => s.selection.zoom(0.5, s.selection.time_s.peek()),
  },
  { keys: ["-"], label: "zoom out", group: "Span and zoom", run: (s) => s.selection.zoom(2, s.selection.time_s.peek()) },
  { keys: ["0"], label: "show all", group: "Span and zoom", run: (s) => s.selection.setWindow(s.selection.whole) },
  {
    keys: ["z"],
    label: "zoom to the span",
    group: "Span and zoom",
    run: (s) => s.selection.setWindow(s.selection.span.peek() ?? s.selection.whole),
  },
  { keys: ["p"], label: "add a plot", group: "Span and zoom", run: () => openOverlay("values") },
];

const scene: Action[] = [
  ...CAMERAS.map(
    (camera, i): Action => ({
      keys: [String(i + 1)],
      label: `camera: ${camera.label.toLowerCase()}`,
      group: "3D",
      run: (s) => {
        s.scene.camera.value = camera.id;
      },
    }),
  ),
  { keys: ["f"], label: "fit the target into the view", group: "3D", run: (s) => s.scene.ask("fit") },
  { keys: ["c"], label: "next colour of points", group: "3D", run: nextColour },
  { keys: ["m"], label: "measure between two points", group: "3D", run: (s) => s.scene.toggleMeasuring() },
  { keys: ["Enter"], label: "while measuring: take the point at the cross", group: "3D", run: (s) => s.scene.ask("pick") },
  { keys: ["Ctrl+ArrowLeft"], label: "turn the view left", group: "3D", run: (s) => s.scene.ask("left") },
  { keys: ["Ctrl+ArrowRight"], label: "turn the view right", group: "3D", run: (s) => s.scene.ask("right") },
  { keys: ["Ctrl+ArrowUp"], label: "turn the view up", group: "3D", run: (s) => s.scene.ask("up") },
  { keys: ["Ctrl+ArrowDown"], label: "turn the view down", group: "3D", run: (s) => s.scene.ask("down") },
  { keys: ["PageUp"], label: "camera nearer", group: "3D", run: (s) => s.scene.ask("nearer") },
  { keys: ["PageDown"], label: "camera farther", group: "3D", run: (s) => s.scene.ask("farther") },
];

function leave(s: Session): void {
  if (overlay.peek() !== null) overlay.value = null;
  else if (s.scene.measuring.peek()) s.scene.toggleMeasuring();
  else if (s.selection.span.peek() !== null) s.selection.setSpan(null);
  else (document.activeElement as HTMLElement | null)?.blur();
}

const page: Action[] = [
  { keys: ["?"], label: "show the keys", group: "Page", run: () => openOverlay("keys") },
  { keys: ["t"], label: "light or dark", group: "Page", run: toggleTheme },
  { keys: ["Ctrl+z"], label: "undo", group: "Page", run: (s) => undo(s, false) },
  { keys: ["Ctrl+Shift+z", "Ctrl+y"], label: "do again", group: "Page", run: (s) => undo(s, true) },
  { keys: ["Escape"], label: "close, end measuring, clear the span", group: "Page", run: leave },
];

export const ACTIONS: readonly Action[] = [...play, ...find, ...span, ...scene, ...page];

const byKey = new Map(ACTIONS.flatMap((action) => action.keys.map((key) => [key, action] as const)));

export function actionOf(stroke: string): Action | undefined {
  return byKey.get(stroke);
}
