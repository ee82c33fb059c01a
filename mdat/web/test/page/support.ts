// What all tests of the page share: a page that is let in, and on which no error may appear and no request may leave the machine.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { test as base, expect, type Page } from "@playwright/test";

const AXE = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");

interface Watched {
  /** The page; at the end of the test it must have had no error, and asked nobody but the server. */
  page: Page;
  /** Errors of the console that a test brings about on purpose. */
  expected: { pattern: RegExp | null };
}

export const test = base.extend<Watched>({
  // biome-ignore lint/correctness/noEmptyPattern: Playwright asks for a pattern
  baseURL: async ({}, use) => use(new URL(process.env.PAGE_ADDRESS!).origin),
  expected: [{ pattern: null }, { option: true }],
  page: async ({ page, expected }, use) => {
    const errors: string[] = [];
    const strangers: string[] = [];
    page.on("console", (message) => message.type() === "error" && errors.push(message.text()));
    page.on("pageerror", (error) => errors.push(String(error)));
    page.on("request", (request) => {
      const url = new URL(request.url());
      if (!["127.0.0.1", ""].includes(url.hostname)) strangers.push(request.url());
    });
    await page.goto(process.env.PAGE_ADDRESS!);
    await use(page);
    expect(strangers, "requests that leave the machine").toEqual([]);
    expect(
      errors.filter((text) => !(expected.pattern?.test(text) ?? false)),
      "errors of the page",
    ).toEqual([]);
  },
});

export { expect };

/** Opens a recording by its name and waits until its scan is drawn. */
export async function open(page: Page, name: string, frame = 0): Promise<void> {
  const entries = (await (await page.request.get("/api/recordings")).json()) as { id: string; name: string }[];
  const entry = entries.find((each) => each.name === name);
  expect(entry, name).toBeDefined();
  await page.goto(`/#/r/${entry!.id}?frame=${frame}`);
  await drawn(page, frame);
}

/** Waits until the 3D view shows a frame. */
export async function drawn(page: Page, frame: number): Promise<void> {
  await expect(page.locator(`.scene-canvas[data-frame="${frame}"]`)).toBeAttached();
}

export const frameOf = async (page: Page): Promise<number> => Number(await page.locator("#frame-number").inputValue());

/** An element as it is on the screen: a PNG. */
export async function pictureOf(page: Page, selector: string): Promise<string> {
  return (await page.locator(selector).screenshot()).toString("base64");
}

/** How many pixels of two pictures of one size differ by more than rounding, in the uppermost rows or in all. */
export function differing(page: Page, a: string, b: string, rows?: number): Promise<number> {
  return page.evaluate(
    async ([first, second, most]) => {
      const pixels = async (data: string) => {
        const image = new Image();
        image.src = `data:image/png;base64,${data}`;
        await image.decode();
        const canvas = new OffscreenCanvas(image.width, image.height);
        const pen = canvas.getContext("2d")!;
        pen.drawImage(image, 0, 0);
        return pen.getImageData(0, 0, image.width, Math.min(image.height, most)).data;
      };
      const [left, right] = [await pixels(first), await pixels(second)];
      let count = 0;
      for (let i = 0; i < left.length; i += 4) {
        const off = Math.abs(left[i] - right[i]) + Math.abs(left[i + 1] - right[i + 1]) + Math.abs(left[i + 2] - right[i + 2]);
        if (off > 24) ++count;
      }
      return count;
    },
    [a, b, rows ?? 10_000] as const,
  );
}

/** Findings of axe that are serious or worse, one line each. */
export async function seriousFindings(page: Page): Promise<string[]> {
  // The page's policy forbids scripts of others: the debugger's own evaluation is not bound by it.
  await page.evaluate(AXE);
  const { violations } = await page.evaluate(() => (window as unknown as { axe: { run: () => Promise<AxeResults> } }).axe.run());
  return violations
    .filter((finding) => ["serious", "critical"].includes(finding.impact ?? ""))
    .map((finding) => `${finding.id}: ${finding.nodes.map((node) => node.target.join(" ")).join(", ")}`);
}

interface AxeResults {
  violations: { id: string; impact: string | null; nodes: { target: string[] }[] }[];
}

/** Numbers of a canvas's own count of drawings. */
export const drawings = async (page: Page): Promise<number> => Number(await page.locator(".scene-canvas").getAttribute("data-drawn"));
