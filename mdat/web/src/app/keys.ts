// Keys as text: "Shift+ArrowLeft", "Ctrl+z", "?". One text for one stroke.

export type Stroke = Pick<KeyboardEvent, "key" | "ctrlKey" | "metaKey" | "altKey" | "shiftKey"> &
  Partial<Pick<KeyboardEvent, "getModifierState">>;

/** The text of a stroke. AltGr writes signs on many keyboards ("[" on a German one), and is no modifier here. Shift is said only with keys that are not signs: "?" is "?" on every keyboard. */
export function strokeOf(event: Stroke): string {
  const sign = event.key.length === 1;
  const letter = sign && event.key.toLowerCase() !== event.key.toUpperCase();
  const key = event.key === " " ? "Space" : letter ? event.key.toLowerCase() : event.key;
  const parts: string[] = [];
  const writes = event.getModifierState?.("AltGraph") ?? false;
  if (!writes && (event.ctrlKey || event.metaKey)) parts.push("Ctrl");
  if (!writes && event.altKey) parts.push("Alt");
  if (event.shiftKey && (!sign || letter || event.key === " ")) parts.push("Shift");
  return [...parts, key].join("+");
}

const SIGNS: Record<string, string> = { ArrowLeft: "←", ArrowRight: "→", ArrowUp: "↑", ArrowDown: "↓", Escape: "Esc" };

/** A stroke as it is shown to people, in parts: each is drawn as one key. */
export function strokeParts(stroke: string): string[] {
  return stroke.split(/\+(?=.)/).map((part) => SIGNS[part] ?? (part.length === 1 ? part.toUpperCase() : part));
}

/** True where a stroke belongs to what has the focus: text, and space or Enter on what they press. */
export function takesStroke(target: { tagName: string; isContentEditable: boolean; type?: string }, stroke: string): boolean {
  const tag = target.tagName;
  if (target.isContentEditable || tag === "TEXTAREA") return true;
  if (tag === "INPUT") return stroke !== "Escape" && (!["checkbox", "radio", "button"].includes(target.type ?? "") || stroke === "Space");
  if (tag === "SELECT") return stroke !== "Escape";
  return (tag === "BUTTON" || tag === "A" || tag === "SUMMARY") && (stroke === "Space" || stroke === "Enter");
}
