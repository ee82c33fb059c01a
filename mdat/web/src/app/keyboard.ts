// Listens to the keyboard for the whole page.
import { actionOf } from "./actions.ts";
import { strokeOf, takesStroke } from "./keys.ts";
import { overlay } from "./overlay.ts";
import { session } from "./session.ts";
import { toggleTheme } from "./theme.ts";

function onKey(event: KeyboardEvent): void {
  if (event.defaultPrevented) return;
  const stroke = strokeOf(event);
  if (takesStroke(event.target as HTMLElement, stroke)) return;
  if (overlay.peek() !== null) return;
  const open = session.peek();
  if (open === null) onStartPage(stroke);
  else {
    const action = actionOf(stroke);
    if (action === undefined) return;
    event.preventDefault();
    action.run(open);
  }
}

/** Without a recording there is only help and the theme. */
function onStartPage(stroke: string): void {
  if (stroke === "?") overlay.value = "keys";
  if (stroke === "t") toggleTheme();
}

/** After a click with the mouse the keys belong to the page again, not to the button. */
function onClick(event: MouseEvent): void {
  const button = (event.target as HTMLElement).closest?.("button");
  if (event.detail > 0 && button !== null && button !== undefined) button.blur();
}

export function startKeyboard(): void {
  window.addEventListener("keydown", onKey);
  window.addEventListener("click", onClick);
}
