// What the head of each page ends with: the list of keys, and the theme.
import { IconButton } from "../parts/controls.tsx";
import { openOverlay } from "./overlay.ts";
import { theme, toggleTheme } from "./theme.ts";

export function CommonTools() {
  const dark = theme.value === "dark";
  return (
    <>
      <IconButton icon="keys" label="Keys" stroke="?" onClick={() => openOverlay("keys")} />
      <IconButton icon={dark ? "sun" : "moon"} label={dark ? "Light" : "Dark"} stroke="t" onClick={toggleTheme} />
    </>
  );
}
