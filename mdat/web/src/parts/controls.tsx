// Buttons and fields that all views use.
import type { ComponentChildren } from "preact";
import { strokeParts } from "../app/keys.ts";
import { remark } from "../app/notices.ts";
import { Icon, type IconName } from "./icon.tsx";

interface IconButtonProps {
  icon: IconName;
  label: string;
  stroke?: string;
  pressed?: boolean;
  disabled?: boolean;
  onClick: () => void;
}

/** A button of an icon; its name and key are in the tip, and are read aloud. */
export function IconButton({ icon, label, stroke, pressed, disabled, onClick }: IconButtonProps) {
  const tip = stroke === undefined ? label : `${label} (${strokeParts(stroke).join(" ")})`;
  return (
    <button type="button" class="icon-button" title={tip} aria-label={label} aria-pressed={pressed} disabled={disabled} onClick={onClick}>
      <Icon name={icon} />
    </button>
  );
}

export function Keys({ stroke }: { stroke: string }) {
  return (
    <span class="keys">
      {strokeParts(stroke).map((part) => (
        <kbd key={part}>{part}</kbd>
      ))}
    </span>
  );
}

async function copy(text: string): Promise<void> {
  await navigator.clipboard.writeText(text).then(
    () => remark("Copied."),
    () => remark("The browser does not allow copying: select the text and copy it by hand."),
  );
}

/** A command of the command line, to copy. */
export function CommandText({ text, label }: { text: string; label?: string }) {
  return (
    <span class="command-text">
      <input readOnly aria-label={label ?? "command"} value={text} onFocus={(event) => event.currentTarget.select()} />
      <IconButton icon="copy" label="Copy the command" onClick={() => copy(text)} />
    </span>
  );
}

interface PanelProps {
  id: string;
  title: string;
  tools?: ComponentChildren;
  children: ComponentChildren;
}

/** A view with its title and tools. */
export function Panel({ id, title, tools, children }: PanelProps) {
  return (
    <section class={`panel panel-${id}`} aria-label={title} data-view={id}>
      <header class="panel-head">
        <h2>{title}</h2>
        <div class="panel-tools">{tools}</div>
      </header>
      <div class="panel-body">{children}</div>
    </section>
  );
}

export function Empty({ title, children }: { title: string; children?: ComponentChildren }) {
  return (
    <div class="empty">
      <strong>{title}</strong>
      <p>{children}</p>
    </div>
  );
}

/** Hands a file to the browser, as if it had been downloaded. */
export function saveFile(name: string, content: Blob): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(content);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}
