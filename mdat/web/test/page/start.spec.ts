import { differing, drawn, expect, frameOf, pictureOf, test } from "./support.ts";

test("a first visit shows the tenth-scale Hubble being tracked after one click, and says what can be done next", async ({ page }) => {
  await page.goto(process.env.PAGE_EMPTY_ADDRESS!);
  await expect(page.getByText("There is no recording here yet.")).toBeVisible();
  await expect(page.locator(".next-steps li")).toHaveCount(3);
  await page.getByRole("button", { name: "Fly and watch" }).click();
  await expect(page.locator(".scene-canvas[data-frame]")).toBeAttached({ timeout: 90_000 });
  const before = await frameOf(page);
  await expect.poll(() => frameOf(page)).toBeGreaterThan(before + 2);
  await page.keyboard.press("k");
  const tracked = await pictureOf(page, ".stage");
  await page.getByTitle("What is shown").click();
  await page.getByLabel("Target at the estimate").click();
  await page.getByTitle("What is shown").click();
  await page.waitForTimeout(200);
  expect(await differing(page, tracked, await pictureOf(page, ".stage")), "pixels of the target").toBeGreaterThan(500);
  await page.getByRole("link", { name: "MDAT" }).click();
  await expect(page.locator(".recordings tbody tr")).toHaveCount(1);
});

test("recordings are listed with size and time, and opened by a click", async ({ page }) => {
  await expect(page.locator(".recordings tbody tr")).toHaveCount(5);
  await expect(page.locator(".recordings tr", { hasText: "spin.mcap" })).toContainText(/\d MB.*\d{4}-\d\d-\d\d \d\d:\d\d/);
  await page.getByRole("link", { name: "spin.mcap" }).click();
  await drawn(page, 0);
  await expect(page.getByRole("heading", { level: 1 })).toHaveText("spin.mcap");
  await page.goBack();
  await expect(page.getByRole("heading", { level: 1 })).toHaveText("Fly and replay");
});

test("the first load is small", async ({ page, context }) => {
  await page.getByRole("link", { name: "spin.mcap" }).waitFor();
  const fresh = await context.newPage();
  const begun = Date.now();
  await fresh.goto("/");
  await fresh.getByRole("link", { name: "spin.mcap" }).waitFor();
  const load_ms = Date.now() - begun;
  await fresh.getByRole("link", { name: "spin.mcap" }).click();
  await drawn(fresh, 0);
  const bytes = await fresh.evaluate(() =>
    (performance.getEntriesByType("resource") as PerformanceResourceTiming[])
      .filter((entry) => /\.(js|css|svg)$/.test(new URL(entry.name).pathname))
      .reduce((sum, entry) => sum + entry.encodedBodySize, 0),
  );
  test
    .info()
    .annotations.push({ type: "figure", description: `first load ${load_ms} ms, ${Math.round(bytes / 1000)} kB before the 3D view` });
  expect(bytes).toBeGreaterThan(50_000);
  expect(bytes).toBeLessThan(250_000);
});

test("each recording shows the commands that do the same, to copy", async ({ page }) => {
  await page.getByRole("link", { name: "spin.mcap" }).click();
  await drawn(page, 0);
  await page.getByRole("button", { name: "Command" }).click();
  await expect(page.getByLabel("command of the replay")).toHaveValue("mdat replay spin.mcap");
  await page.getByRole("button", { name: "Copy the command" }).first().click();
  expect(await page.evaluate(() => navigator.clipboard.readText())).toBe("mdat replay spin.mcap");
  await page.keyboard.press("Escape");
  await expect(page.getByRole("dialog")).toHaveCount(0);
});
