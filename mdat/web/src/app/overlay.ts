// The one dialog that may lie over the page.
import { signal } from "@preact/signals";

export type OverlayName = "keys" | "values" | "command" | "orders" | "mesh";

export const overlay = signal<OverlayName | null>(null);

export function openOverlay(name: OverlayName): void {
  overlay.value = name;
}
