// A dialog over the page: the browser's own, which keeps the focus inside and gives it back.
import type { ComponentChildren } from "preact";
import { useLayoutEffect, useRef } from "preact/hooks";
import { overlay } from "../app/overlay.ts";
import { IconButton } from "./controls.tsx";

const FIRST_FIELD = ".dialog-body :is(input:not([readonly]), select):not(:disabled)";

function closeOverlay(): void {
  overlay.value = null;
}

/** `onClose`: of a dialog that is not the page's overlay. */
export function Dialog({
  title,
  onClose: close = closeOverlay,
  children,
}: {
  title: string;
  onClose?: () => void;
  children: ComponentChildren;
}) {
  const dialog = useRef<HTMLDialogElement>(null);
  // Before the browser draws: strokes right behind the one that opened it are the dialog's.
  useLayoutEffect(() => {
    dialog.current?.showModal();
    // The browser would take the button that closes it: Enter would then do nothing of what was asked for.
    dialog.current?.querySelector<HTMLElement>(FIRST_FIELD)?.focus();
    // A click beside the dialog closes it, as Escape does.
    dialog.current?.addEventListener("click", (event) => event.target === dialog.current && close());
  }, []);
  return (
    <dialog ref={dialog} class="dialog" aria-label={title} onClose={close}>
      <header>
        <h2>{title}</h2>
        <IconButton icon="close" label="Close" stroke="Escape" onClick={close} />
      </header>
      <div class="dialog-body" tabIndex={0}>
        {children}
      </div>
    </dialog>
  );
}
