// The line between two views: dragged, or moved by arrow keys.
import type { Signal } from "@preact/signals";
import { textScale } from "./rem.ts";

interface SplitterProps {
  label: string;
  /** "x" parts left from right, and the size is that of what is right; "y" top from bottom. */
  axis: "x" | "y";
  /** In thirteenths of a rem. */
  size: Signal<number>;
  least: number;
  most: number;
}

const STEP = 24;

export function Splitter({ label, axis, size, least, most }: SplitterProps) {
  const set = (value: number) => {
    size.value = Math.round(Math.min(most, Math.max(least, value)));
  };
  const onPointerDown = (event: PointerEvent) => {
    const handle = event.currentTarget as HTMLElement;
    const at = (e: PointerEvent) => (axis === "x" ? e.clientX : e.clientY);
    const from = at(event);
    const before = size.peek();
    handle.setPointerCapture(event.pointerId);
    handle.onpointermove = (e) => set(before + (from - at(e)) / textScale());
    handle.onpointerup = () => {
      handle.onpointermove = null;
    };
  };
  const onKeyDown = (event: KeyboardEvent) => {
    const more = axis === "x" ? "ArrowLeft" : "ArrowUp";
    const less = axis === "x" ? "ArrowRight" : "ArrowDown";
    if (event.key !== more && event.key !== less) return;
    event.preventDefault();
    set(size.peek() + (event.key === more ? STEP : -STEP));
  };
  return (
    <div
      class={`splitter splitter-${axis}`}
      role="separator"
      tabIndex={0}
      aria-label={label}
      aria-orientation={axis === "x" ? "vertical" : "horizontal"}
      aria-valuenow={size.value}
      aria-valuemin={least}
      aria-valuemax={most}
      onPointerDown={onPointerDown}
      onKeyDown={onKeyDown}
    />
  );
}
