// The pointer over an axis of time, the same on the time line and in plots: a click sets the time, a drag marks a span (or moves what is
// shown, with Shift), the wheel zooms, a double click shows all.

import { orderedSpan } from "../log/selection.ts";
import { setting } from "./history.ts";
import type { Session } from "./session.ts";

const CLICK_PX = 4;
const ZOOM_STEP = 1.0015;

interface Axis {
  session: Session;
  /** The time under a pointer. */
  timeAt: (event: MouseEvent) => number;
  /** A drag moves the time (the time line) or marks a span (plots). */
  drag: "time" | "span";
}

function dragTime(axis: Axis, event: PointerEvent): void {
  axis.session.player.pause();
  axis.session.selection.setTime(axis.timeAt(event));
}

/** Begins to follow the pointer; what follows depends on Shift. */
function begin(axis: Axis, element: HTMLElement, down: PointerEvent): void {
  if (down.button !== 0) return;
  element.setPointerCapture(down.pointerId);
  const { selection, history } = axis.session;
  const from_s = axis.timeAt(down);
  const before = selection.span.peek();
  const kind = down.shiftKey ? "pan" : axis.drag;
  let moved = false;
  if (kind === "time") dragTime(axis, down);
  element.onpointermove = (event) => {
    moved ||= Math.abs(event.clientX - down.clientX) > CLICK_PX;
    if (!moved) return;
    if (kind === "time") dragTime(axis, event);
    else if (kind === "pan") selection.pan(from_s - axis.timeAt(event));
    else selection.setSpan({ from_s, to_s: axis.timeAt(event) });
  };
  element.onpointerup = element.onpointercancel = (event) => {
    element.onpointermove = element.onpointerup = element.onpointercancel = null;
    if (kind !== "span") return;
    if (!moved) dragTime(axis, event);
    else {
      const span = orderedSpan(from_s, axis.timeAt(event), selection.whole);
      selection.span.value = before;
      history.run(setting("the span", selection.span, span));
    }
  };
}

/** Listens; returns what ends it. */
export function followPointer(element: HTMLElement, axis: Axis): () => void {
  const { selection } = axis.session;
  const down = (event: PointerEvent) => begin(axis, element, event);
  const hover = (event: PointerEvent) => {
    selection.hovered_s.value = axis.timeAt(event);
  };
  const leave = () => {
    selection.hovered_s.value = null;
  };
  const wheel = (event: WheelEvent) => {
    event.preventDefault();
    if (event.shiftKey || Math.abs(event.deltaX) > Math.abs(event.deltaY)) {
      const { from_s, to_s } = selection.window.peek();
      selection.pan(((event.deltaX || event.deltaY) / 800) * (to_s - from_s));
    } else selection.zoom(ZOOM_STEP ** event.deltaY, axis.timeAt(event));
  };
  const double = () => selection.setWindow(selection.whole);
  element.addEventListener("pointerdown", down);
  element.addEventListener("pointermove", hover);
  element.addEventListener("pointerleave", leave);
  element.addEventListener("wheel", wheel, { passive: false });
  element.addEventListener("dblclick", double);
  return () => {
    element.removeEventListener("pointerdown", down);
    element.removeEventListener("pointermove", hover);
    element.removeEventListener("pointerleave", leave);
    element.removeEventListener("wheel", wheel);
    element.removeEventListener("dblclick", double);
  };
}
