// Asks the server. Each failure becomes one ApiError that says what happened and what helps.
import { sentence } from "../maths/scales.ts";

export class ApiError extends Error {
  readonly remedy: string;
  readonly status: number;

  constructor(what: string, remedy: string, status: number) {
    super(what);
    this.name = "ApiError";
    this.remedy = remedy;
    this.status = status;
  }
}

const NO_ANSWER = new ApiError(
  "The server does not answer.",
  "See whether mdat serve still runs; start it again and open the address that it prints.",
  0,
);

/** An answer without the server's own words gets these. */
function plainWords(status: number): { error: string; remedy: string } {
  if (status === 401 || status === 403)
    return { error: "The server does not know this browser.", remedy: "Open the address that mdat serve printed, with its token." };
  return { error: `The server answered with status ${status}.`, remedy: "Reload the page; if it stays, see what mdat serve printed." };
}

async function errorOf(response: Response): Promise<ApiError> {
  const words = plainWords(response.status);
  try {
    const said = (await response.json()) as { error?: string; remedy?: string };
    return new ApiError(said.error ?? words.error, sentence(said.remedy ?? words.remedy), response.status);
  } catch (error) {
    if (wasAborted(error)) throw error;
    return new ApiError(words.error, words.remedy, response.status);
  }
}

async function ask(path: string, options: RequestInit): Promise<Response> {
  let response: Response;
  try {
    response = await fetch(path, { credentials: "same-origin", ...options });
  } catch (error) {
    if (wasAborted(error)) throw error;
    throw NO_ANSWER;
  }
  if (!response.ok) throw await errorOf(response);
  return response;
}

export async function getJson<T>(path: string, signal?: AbortSignal): Promise<T> {
  return (await (await ask(path, { signal: signal ?? null })).json()) as T;
}

export async function getBinary(path: string, signal?: AbortSignal): Promise<ArrayBuffer> {
  return (await ask(path, { signal: signal ?? null })).arrayBuffer();
}

/** With a body the server takes it as JSON. */
export async function postJson<T>(path: string, body?: object): Promise<T> {
  const sent = body === undefined ? {} : { headers: { "Content-Type": "application/json" }, body: JSON.stringify(body) };
  return (await (await ask(path, { method: "POST", ...sent })).json()) as T;
}

/** With a body of JSON; the answer is binary. */
export async function postBinary(path: string, body: object): Promise<ArrayBuffer> {
  return (await ask(path, { method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify(body) })).arrayBuffer();
}

/** A file's bytes, as they are. */
export async function postBytes<T>(path: string, bytes: Blob): Promise<T> {
  const headers = { "Content-Type": "application/octet-stream" };
  return (await (await ask(path, { method: "POST", headers, body: bytes })).json()) as T;
}

/** A path with the arguments that are not empty. */
export function withQuery(path: string, query: Record<string, string | number | undefined>): string {
  const search = new URLSearchParams();
  for (const [key, value] of Object.entries(query)) if (value !== undefined && value !== "") search.set(key, String(value));
  const text = search.toString();
  return text === "" ? path : `${path}?${text}`;
}

/** True of a request that was given up on purpose. */
export function wasAborted(error: unknown): boolean {
  return error instanceof DOMException && error.name === "AbortError";
}
