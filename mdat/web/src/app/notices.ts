// Short messages to the user: a failure stays until it is closed, a remark goes by itself. Both are read aloud by screen readers.
import { signal } from "@preact/signals";
import { ApiError, wasAborted } from "../api/client.ts";

export interface Notice {
  id: number;
  kind: "error" | "remark";
  what: string;
  remedy: string;
}

const REMARK_MS = 4000;
let counter = 0;

export const notices = signal<Notice[]>([]);

function put(kind: Notice["kind"], what: string, remedy: string): Notice {
  const notice = { id: ++counter, kind, what, remedy };
  notices.value = [...notices.peek().filter((other) => other.what !== what && other.kind === "error"), notice];
  return notice;
}

export function dismiss(id: number): void {
  notices.value = notices.peek().filter((notice) => notice.id !== id);
}

export function remark(what: string): void {
  const { id } = put("remark", what, "");
  setTimeout(() => dismiss(id), REMARK_MS);
}

/** Tells a failure; a request that was given up is none. */
export function tell(error: unknown): void {
  if (wasAborted(error)) return;
  if (error instanceof ApiError) put("error", error.message, error.remedy);
  else
    put(
      "error",
      error instanceof Error ? error.message : String(error),
      "Reload the page. If it stays, this is a fault of the page: please report it.",
    );
}
