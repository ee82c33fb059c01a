import { differing, drawn, expect, open, pictureOf, test } from "./support.ts";

test("a refused frame says by which gate, with value and limit", async ({ page }) => {
  await open(page, "checked.mcap", 3);
  await expect(page.locator(".chip-refused")).toBeVisible();
  await expect(page.locator(".why-sentence")).not.toBeEmpty();
  await page.keyboard.press("End");
  await expect(page.locator(".chip-valid")).toBeVisible();
  const gates = page.locator(".panel-why table").first();
  await expect(gates.locator("tbody tr")).not.toHaveCount(0);
  await expect(gates).toContainText(/[≥≤] \d/);
});

test("a gate that fails stands first and is marked", async ({ page }) => {
  await open(page, "turned.mcap", 0);
  await page.keyboard.press("r");
  await expect(page.locator(".chip-refused")).toBeVisible();
  const frame = await page.request.get(page.url().replace(/#\/r\/([0-9a-f]+)\?frame=(\d+)/, "api/recordings/$1/frames/$2"));
  const { gates } = (await frame.json()) as { gates: { pass: boolean }[] };
  await expect(page.locator(".panel-why tr.fails")).toHaveCount(gates.filter((gate) => !gate.pass).length);
});

test("each iteration's residuals are shown on the scan", async ({ page }) => {
  await open(page, "spin.mcap", 30);
  const start = page.getByRole("button", { name: "start", exact: true });
  await expect(start).toBeVisible();
  const result = await pictureOf(page, ".scene-canvas");
  await start.click();
  await expect.poll(async () => differing(page, result, await pictureOf(page, ".scene-canvas"))).toBeGreaterThan(10);
  await page.keyboard.press("ArrowRight");
  await drawn(page, 31);
  await expect(page.locator(".panel-why tr.chosen")).toHaveCount(0);
});

test("poses stand beside the truth", async ({ page }) => {
  await open(page, "spin.mcap", 30);
  await page.getByText("Poses of the target in the sensor's frame").click();
  const estimate = page.locator(".panel-why tr", { hasText: "estimate" });
  await expect(estimate).toContainText(/mm, .*°/);
});
