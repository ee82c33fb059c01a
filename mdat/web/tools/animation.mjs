// animation.mjs OUT.webp: flies the tenth-scale Hubble live in the page, and writes what it shows as an animated WebP in the pace of the flight.
// Needs the mdat of MDAT (out/build) with its page, and the Chromium of CHROMIUM. What was recorded is removed again.
import { spawn } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { createInterface } from "node:readline";
import { fileURLToPath } from "node:url";
import { chromium } from "@playwright/test";

const TOP = resolve(fileURLToPath(new URL("../../..", import.meta.url)));
const MDAT = resolve(process.env.MDAT ?? join(TOP, "out/build/mdat/mdat"));
const PICTURES = 22;
const PERIOD_MS = 200; // of the sensor's frames
const QUALITY = 58;
const VIEW = { width: 1120, height: 660 };

/** A chunk of RIFF: its name, its length, its bytes, and one more where they are odd. */
function chunk(name, bytes) {
  const head = Buffer.alloc(8);
  head.write(name, 0, "latin1");
  head.writeUInt32LE(bytes.length, 4);
  return Buffer.concat([head, bytes, Buffer.alloc(bytes.length % 2)]);
}

function uint24(value) {
  return Buffer.from([value & 255, (value >> 8) & 255, value >> 16]);
}

/** The chunk with the image of a WebP, without what says how it is to be shown. */
function imageOf(webp) {
  for (let at = 12; at < webp.length; ) {
    const name = webp.toString("latin1", at, at + 4);
    const length = 8 + webp.readUInt32LE(at + 4);
    if (name === "VP8 " || name === "VP8L") return webp.subarray(at, at + length + (length % 2));
    at += length + (length % 2);
  }
  throw new Error("the browser gave no WebP");
}

/** Pictures of one size, each shown for PERIOD_MS, again and again: the container of WebP (RFC 9649). */
function animated(pictures, width, height) {
  const size = Buffer.concat([uint24(width - 1), uint24(height - 1)]);
  const shown = Buffer.concat([uint24(PERIOD_MS), Buffer.from([2])]); // 2: over what was there, not blended
  const frames = pictures.map((picture) => chunk("ANMF", Buffer.concat([uint24(0), uint24(0), size, shown, imageOf(picture)])));
  const body = [chunk("VP8X", Buffer.concat([Buffer.from([2, 0, 0, 0]), size])), chunk("ANIM", Buffer.alloc(6)), ...frames];
  return chunk("RIFF", Buffer.concat([Buffer.from("WEBP", "latin1"), ...body]));
}

async function serve(folder) {
  const server = spawn(MDAT, ["serve", folder, "--port", "0"], { cwd: TOP, stdio: ["ignore", "pipe", "ignore"] });
  const address = await new Promise((done) => createInterface({ input: server.stdout }).once("line", done));
  return { server, address };
}

/** The page with a run that flies at a tenth of its pace: software that draws needs its time. */
async function fly(browser, address) {
  const page = await browser.newPage({ viewport: VIEW, colorScheme: "dark" });
  page.setDefaultTimeout(120_000);
  await page.goto(address);
  await page.getByLabel("Pace of the run").selectOption("0.1");
  await page.getByRole("button", { name: "Fly live" }).click();
  await page.getByLabel("Close the first steps").click();
  await page.locator(".scene-canvas[data-frame]").first().waitFor();
  return page;
}

/** The next frame, drawn with all that is told of it. */
async function nextFrame(page, before) {
  const shown = (last) => {
    const frame = document.querySelector(".scene-canvas")?.dataset.frame;
    return frame !== last && document.querySelector(".verdict-frame")?.textContent.startsWith(`frame ${frame},`) ? frame : "";
  };
  return (await page.waitForFunction(shown, before, { polling: 50 })).jsonValue();
}

async function pictures(page) {
  const debug = await page.context().newCDPSession(page);
  const taken = [];
  for (let frame = ""; taken.length < PICTURES; ) {
    frame = await nextFrame(page, frame);
    const { data } = await debug.send("Page.captureScreenshot", { format: "webp", quality: QUALITY });
    taken.push(Buffer.from(data, "base64"));
  }
  return taken;
}

const folder = mkdtempSync(join(tmpdir(), "mdat-animation-"));
const { server, address } = await serve(folder);
const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
});
try {
  const page = await fly(browser, address);
  const film = animated(await pictures(page), VIEW.width, VIEW.height);
  writeFileSync(process.argv[2], film);
  console.log(`${process.argv[2]}: ${PICTURES} pictures, ${Math.ceil(film.length / 1000)} kB`);
} finally {
  await browser.close();
  server.kill("SIGINT");
  rmSync(folder, { recursive: true, force: true });
}
