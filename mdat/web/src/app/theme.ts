// Light or dark: as the system says until the user chooses.
import { signal } from "@preact/signals";
import { remembered } from "./remembered.ts";

export type Theme = "light" | "dark";

const chosen = remembered<Theme | "">("theme", "");
const system = window.matchMedia("(prefers-color-scheme: dark)");

const current = (): Theme => chosen.peek() || (system.matches ? "dark" : "light");

export const theme = signal<Theme>(current());

function apply(): void {
  theme.value = current();
  document.documentElement.dataset.theme = theme.peek();
}

system.addEventListener("change", apply);
apply();

export function toggleTheme(): void {
  chosen.value = theme.peek() === "dark" ? "light" : "dark";
  apply();
}

/** A custom property of the style sheet, as the theme has it now. */
export function cssValue(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

export function reducedMotion(): boolean {
  return window.matchMedia("(prefers-reduced-motion: reduce)").matches;
}
