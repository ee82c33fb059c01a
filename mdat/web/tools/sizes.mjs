// Files stay under 400 lines: what is longer is two things.
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";

const MOST_LINES = 400;
const ENDINGS = /\.(ts|tsx|mjs|css)$/;

/** All files below a folder. */
export function filesBelow(folder) {
  return readdirSync(folder, { withFileTypes: true }).flatMap((entry) =>
    entry.isDirectory() ? filesBelow(join(folder, entry.name)) : [join(folder, entry.name)],
  );
}

const here = new URL("..", import.meta.url).pathname;
const files = ["src", "test", "tools"].flatMap((folder) => filesBelow(join(here, folder))).filter((name) => ENDINGS.test(name));
const long = files.map((name) => [name, readFileSync(name, "utf8").split("\n").length]).filter(([, lines]) => lines > MOST_LINES);
for (const [name, lines] of long) console.error(`${name}: ${lines} lines, at most ${MOST_LINES} are allowed`);
process.exit(long.length > 0 ? 1 : 0);
