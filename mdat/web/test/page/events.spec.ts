import { expect, frameOf, open, test } from "./support.ts";

test("events are filtered by text and level, and one that is chosen is gone to", async ({ page }) => {
  await open(page, "turned.mcap");
  const rows = page.locator(".event");
  await expect(rows.first()).toBeVisible();
  const list = page.getByRole("listbox");
  const all = Number((await list.getAttribute("aria-label"))!.split(" ")[0]);
  expect(all).toBeGreaterThan(3);
  await page.keyboard.press("/");
  await page.keyboard.type("tracking");
  await expect.poll(async () => Number((await list.getAttribute("aria-label"))!.split(" ")[0])).toBeLessThan(all);
  for (const text of await rows.allTextContents()) expect(text.toLowerCase()).toContain("tracking");
  await rows.last().click();
  const seconds = Number.parseFloat((await rows.last().locator(".event-time").textContent())!);
  const shown = Number((await page.locator(".where output").textContent())!.replace(" s", ""));
  expect(Math.abs(seconds - shown)).toBeLessThan(0.25);
  await page.getByLabel("Filter events by text").fill("nothing has this");
  await expect(page.getByText("No event fits.")).toBeVisible();
});

test("the list is walked by keys", async ({ page }) => {
  await open(page, "turned.mcap", 20);
  const list = page.getByRole("listbox");
  await list.focus();
  await page.keyboard.press("ArrowDown");
  await expect(page.locator("#event-0")).toHaveAttribute("aria-selected", "true");
  await page.keyboard.press("ArrowDown");
  await page.keyboard.press("ArrowDown");
  await expect(page.locator("#event-2")).toHaveAttribute("aria-selected", "true");
  expect(await frameOf(page)).toBeLessThan(20);
});

test("a level leaves out what is less", async ({ page }) => {
  await open(page, "turned.mcap");
  await expect(page.locator(".event").first()).toBeVisible();
  await page.getByLabel("Level of events").selectOption("warning");
  await expect(page.locator(".event-info")).toHaveCount(0);
});
