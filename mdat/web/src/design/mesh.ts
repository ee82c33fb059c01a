// A new mission for a mesh: what `mdat mission new` does, by the server, in a new folder of its own.
import { type Signal, signal } from "@preact/signals";
import { ApiError, postBytes, withQuery } from "../api/client.ts";
import { openOverlay } from "../app/overlay.ts";
import { shellWord } from "../parts/shell_word.ts";

/** The server takes no more. */
const MOST_BYTES = 2 ** 27;

export const MESH_ENDINGS = ".stl,.obj,.ply,.gltf,.glb,.toml";

export interface MeshWish {
  /** Of the folder and the mission. */
  name: string;
  /** The file's lengths times this are metres. */
  scale: string;
  /** Of a coarser mesh; "" for none. */
  triangles: string;
}

/** What was made: its id, what was guessed, and the command that does the same. */
export interface BegunMission {
  id: string;
  remarks: string[];
  command: string;
}

/** The file that the dialog is about. */
export const mesh: Signal<File | null> = signal(null);
/** The mission that was made last. */
export const begun: Signal<BegunMission | null> = signal(null);

/** Opens the dialog, with a file or to choose one. */
export function chooseMesh(file: File | null): void {
  mesh.value = file;
  openOverlay("mesh");
}

/** A folder's name of the file's: letters, digits, - and _. */
export function folderName(file: string): string {
  const stem = file.replace(/^.*[\\/]/, "").replace(/\.[^.]*$/, "");
  return stem.replace(/[^\w-]+/g, "_").slice(0, 64);
}

export function newCommand(file: string, { name, scale, triangles }: MeshWish): string {
  const words = ["mdat", "mission", "new", "--model", file === "" ? "target.stl" : file];
  if (Number(scale) !== 1) words.push("--scale", scale.trim());
  if (triangles.trim() !== "") words.push("--simplify", triangles.trim());
  return [...words, "--out", `${name || "target"}.toml`].map(shellWord).join(" ");
}

/** Throws ApiError, in the words of the server. */
export async function beginMission(file: File, { name, scale, triangles }: MeshWish): Promise<BegunMission> {
  if (file.size > MOST_BYTES)
    throw new ApiError(
      `${file.name} has ${Math.ceil(file.size / 2 ** 20)} MB.`,
      "The page sends at most 128 MB: take mdat mission new.",
      413,
    );
  const query = { name, file: file.name, scale: scale.trim(), simplify: triangles.trim() };
  return postBytes<BegunMission>(withQuery("/api/mission/new", query), file);
}
