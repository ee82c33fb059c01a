// Builds the page into dist/: index.html, app.js, app.css, favicon.svg, licences.txt and the chunks that the views load when they are first shown.
// With --watch it builds again at each change.
import { cpSync, mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { build, context } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const dist = join(here, "dist");

const options = {
  absWorkingDir: here,
  entryPoints: { app: "src/main.tsx" },
  outdir: dist,
  bundle: true,
  format: "esm",
  splitting: true,
  chunkNames: "[name]-[hash]",
  minify: true,
  target: "es2022",
  jsx: "automatic",
  jsxImportSource: "preact",
  legalComments: "none",
  logLevel: "warning",
  metafile: true,
};

/** Licences of the libraries that are in the page: they ask to be told. */
function licences() {
  const text = (name) => readFileSync(join(here, "node_modules", name, "LICENSE"), "utf8").trim();
  return ["three", "uplot", "preact", "@preact/signals", "@preact/signals-core"].map((name) => `${name}\n\n${text(name)}\n`).join("\n\n");
}

rmSync(dist, { recursive: true, force: true });
mkdirSync(dist, { recursive: true });
writeFileSync(join(dist, "licences.txt"), licences());
for (const name of ["index.html", "favicon.svg"]) cpSync(join(here, "src", name), join(dist, name));
if (process.argv.includes("--watch")) {
  const watched = await context(options);
  await watched.watch();
} else {
  const result = await build(options);
  for (const [name, output] of Object.entries(result.metafile.outputs)) console.log(`${name} ${Math.ceil(output.bytes / 1024)} kB`);
}
