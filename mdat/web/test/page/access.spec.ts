// Every view in both themes: axe finds nothing serious, and a picture is left in out/page/screenshots. The keyboard alone goes through it all.
import { join } from "node:path";
import type { Page } from "@playwright/test";
import { OUT } from "../../playwright.config.ts";
import { drawn, expect, frameOf, open, seriousFindings, test } from "./support.ts";

const VIEWS: [string, (page: Page) => Promise<void>][] = [
  ["start", async (page) => page.getByRole("link", { name: "spin.mcap" }).waitFor()],
  ["first-steps", async (page) => open(page, "spin.mcap", 40)],
  ["replay", async (page) => withoutFirstSteps(page, "spin.mcap", 40)],
  [
    "wrong",
    async (page) => {
      await withoutFirstSteps(page, "turned.mcap", 0);
      await page.keyboard.press("w");
    },
  ],
  [
    "eye",
    async (page) => {
      await withoutFirstSteps(page, "spin.mcap", 40);
      await page.keyboard.press("2");
      await page.keyboard.press("c");
    },
  ],
  [
    "measuring",
    async (page) => {
      await withoutFirstSteps(page, "spin.mcap", 40);
      for (const key of ["m", "Enter", "Control+ArrowRight", "Control+ArrowDown", "Enter"]) await page.keyboard.press(key);
    },
  ],
  [
    "span",
    async (page) => {
      await withoutFirstSteps(page, "spin.mcap", 40);
      for (const key of ["[", "Shift+ArrowRight", "]", "\\"]) await page.keyboard.press(key);
    },
  ],
  [
    "tables",
    async (page) => {
      await withoutFirstSteps(page, "spin.mcap", 40);
      await page.getByRole("button", { name: "Tables in place of plots" }).click();
    },
  ],
  ["keys", async (page) => dialog(page, "?")],
  ["values", async (page) => dialog(page, "p")],
  [
    "command",
    async (page) => {
      await withoutFirstSteps(page, "spin.mcap", 40);
      await page.getByRole("button", { name: "Command" }).click();
    },
  ],
  ["cut", async (page) => withoutFirstSteps(page, "cut.mcap", 5)],
];

async function withoutFirstSteps(page: Page, name: string, frame: number): Promise<void> {
  await open(page, name, frame);
  await page.getByRole("button", { name: "Close the first steps" }).click();
}

async function dialog(page: Page, key: string): Promise<void> {
  await withoutFirstSteps(page, "spin.mcap", 40);
  await page.keyboard.press(key);
  await expect(page.getByRole("dialog")).toBeVisible();
}

for (const theme of ["light", "dark"] as const)
  for (const [name, show] of VIEWS)
    test(`${name}, ${theme}: axe finds nothing serious`, async ({ page }) => {
      await page.emulateMedia({ colorScheme: theme });
      await show(page);
      await page.waitForTimeout(400);
      await page.screenshot({ path: join(OUT, "screenshots", `${name}-${theme}.png`) });
      expect(await seriousFindings(page)).toEqual([]);
    });

for (const [width, height] of [
  [1280, 720],
  [1920, 1080],
  [3840, 2160],
])
  test(`nothing is cut off at ${width} by ${height}`, async ({ page }) => {
    await page.setViewportSize({ width, height });
    await withoutFirstSteps(page, "spin.mcap", 40);
    await page.waitForTimeout(400);
    await page.screenshot({ path: join(OUT, "screenshots", `size-${width}.png`) });
    const over = await page.evaluate(() => ({
      wide: document.documentElement.scrollWidth - innerWidth,
      high: document.documentElement.scrollHeight - innerHeight,
    }));
    expect(over).toEqual({ wide: 0, high: 0 });
    for (const view of ["scene", "why", "events", "plots", "timeline"]) {
      const box = (await page.locator(`[data-view="${view}"]`).boundingBox())!;
      expect(box.x + box.width, view).toBeLessThanOrEqual(width + 1);
      expect(box.y + box.height, view).toBeLessThanOrEqual(height + 1);
      expect(box.height, view).toBeGreaterThan(90);
    }
  });

test("on a narrow screen the views stand below each other, nothing is beside the screen, and the time line stays in reach", async ({
  page,
}) => {
  await page.setViewportSize({ width: 420, height: 900 });
  const beside = () => page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
  await page.getByRole("link", { name: "spin.mcap" }).waitFor();
  expect(await beside(), "start").toBe(0);
  await open(page, "spin.mcap", 40);
  await page.screenshot({ path: join(OUT, "screenshots", "size-420.png") });
  expect(await beside(), "replay").toBe(0);
  let bottom = 0;
  for (const view of ["scene", "why", "events", "plots"]) {
    const box = (await page.locator(`[data-view="${view}"]`).boundingBox())!;
    expect(box.y, view).toBeGreaterThanOrEqual(bottom - 1);
    expect(box.x + box.width, view).toBeLessThanOrEqual(420);
    bottom = box.y + box.height;
  }
  await expect(page.locator('[data-view="timeline"]')).toBeInViewport({ ratio: 1 });
  await page.goto("/#/m/hubble_tenth");
  await page.getByRole("heading", { name: "Tables" }).waitFor();
  expect(await beside(), "design").toBe(0);
});

test("the theme is chosen by a key and kept", async ({ page }) => {
  await page.getByRole("link", { name: "spin.mcap" }).waitFor();
  await page.keyboard.press("t");
  await expect(page.locator("html")).toHaveAttribute("data-theme", "dark");
  await page.reload();
  await expect(page.locator("html")).toHaveAttribute("data-theme", "dark");
});

test("with reduced motion nothing moves by itself", async ({ page }) => {
  await page.emulateMedia({ reducedMotion: "reduce" });
  await open(page, "spin.mcap", 40);
  const durations = await page.evaluate(() =>
    [...document.querySelectorAll("*")]
      .map((element) => getComputedStyle(element))
      .map((style) => `${style.transitionDuration} ${style.animationName}`),
  );
  expect(durations.filter((text) => text !== "0s none")).toEqual([]);
});

/** Presses Tab until the element has the focus. */
async function tabTo(page: Page, selector: string): Promise<void> {
  for (let i = 0; i < 120; ++i) {
    if (await page.evaluate((wanted) => document.activeElement?.matches(wanted) ?? false, selector)) return;
    await page.keyboard.press("Tab");
  }
  throw new Error(`${selector} is not reached by Tab`);
}

test("the keyboard alone opens a recording, finds the worst frame, its reason, a distance, statistics and an event", async ({ page }) => {
  await page.getByRole("link", { name: "turned.mcap" }).waitFor();
  await tabTo(page, ".recordings tr:last-child a");
  await page.keyboard.press("Enter");
  await drawn(page, 0);
  await tabTo(page, ".first-steps button");
  await page.keyboard.press("Enter");
  await expect(page.locator(".first-steps")).toHaveCount(0);
  await page.keyboard.press("w");
  await expect(page.locator(".chip-wrong")).toBeVisible();
  await tabTo(page, ".statistics .link");
  await page.keyboard.press("Enter");
  await drawn(page, await frameOf(page));
  await page.keyboard.press("4");
  for (const key of ["m", "Enter"]) await page.keyboard.press(key === "Enter" ? "Control+ArrowUp" : key);
  await tabTo(page, ".stage");
  await page.keyboard.press("Enter");
  await page.keyboard.press("Control+ArrowRight");
  await page.keyboard.press("Enter");
  await expect(page.locator(".label-distance")).toHaveCount(1);
  await page.keyboard.press("[");
  await page.keyboard.press("Shift+ArrowRight");
  await page.keyboard.press("]");
  await expect(page.locator(".range")).toContainText("Span");
  await page.keyboard.press("/");
  await page.keyboard.type("mode");
  await page.keyboard.press("Escape");
  await tabTo(page, ".event-list");
  await page.keyboard.press("ArrowDown");
  await expect(page.locator(".event.chosen")).toBeVisible();
  await page.keyboard.press("?");
  await expect(page.getByRole("dialog", { name: "Keys" })).toBeVisible();
  await page.keyboard.press("Escape");
  await expect(page.getByRole("dialog")).toHaveCount(0);
});

test("the lines between views are moved by keys", async ({ page }) => {
  await open(page, "spin.mcap", 0);
  const side = page.locator(".place-side");
  const before = (await side.boundingBox())!.width;
  await page.getByRole("separator", { name: "Width of the side" }).focus();
  await page.keyboard.press("ArrowLeft");
  await expect.poll(async () => (await side.boundingBox())!.width).toBeGreaterThan(before);
});
