import { readFileSync } from "node:fs";
import type { Page } from "@playwright/test";
import { expect, frameOf, open, test } from "./support.ts";

/** Drags in the first plot from one share of its width to another. */
async function dragSpan(page: Page, from: number, to: number): Promise<void> {
  const box = (await page.locator(".plot .u-over").first().boundingBox())!;
  await page.mouse.move(box.x + from * box.width, box.y + box.height / 2);
  await page.mouse.down();
  await page.mouse.move(box.x + ((from + to) / 2) * box.width, box.y + box.height / 2);
  await page.mouse.move(box.x + to * box.width, box.y + box.height / 2);
  await page.mouse.up();
}

/** Rows of the CSV that the page offers: time, then the plotted values. */
async function csv(page: Page): Promise<{ head: string; rows: number[][] }> {
  const download = page.waitForEvent("download");
  await page.getByRole("link", { name: "CSV" }).click();
  const lines = readFileSync(await (await download).path(), "utf8")
    .trim()
    .split("\n");
  return { head: lines[0], rows: lines.slice(1).map((line) => line.split(",").map(Number)) };
}

test("any value is plotted by a part of its name, and closing a plot is undone", async ({ page }) => {
  await open(page, "spin.mcap");
  const plots = page.locator(".plot");
  const before = await plots.count();
  await page.keyboard.press("p");
  await page.keyboard.type("angular rate");
  await page.keyboard.press("Enter");
  await expect(plots).toHaveCount(before + 1);
  await expect(plots.last()).toContainText("angular rate, filtered");
  await expect(plots.last().locator("canvas")).toBeVisible();
  await plots
    .last()
    .getByRole("button", { name: /Close the plot/ })
    .click();
  await expect(plots).toHaveCount(before);
  await page.keyboard.press("Control+z");
  await expect(plots).toHaveCount(before + 1);
});

test("values of one unit share a plot", async ({ page }) => {
  await open(page, "spin.mcap");
  const plot = page.locator(".plot").first();
  await plot.getByRole("button", { name: "Add a value in mm" }).click();
  await expect(page.getByRole("dialog")).toBeVisible();
  await page.keyboard.type("x to the right");
  await page.keyboard.press("Enter");
  await expect(plot.locator(".legend li")).toHaveCount(2);
  await plot.getByRole("button", { name: /^Take position error of the registration, x/ }).click();
  await expect(plot.locator(".legend li")).toHaveCount(1);
});

test("statistics are those of the marked span, as the CSV's numbers give them", async ({ page }) => {
  await open(page, "spin.mcap");
  await dragSpan(page, 0.25, 0.75);
  await expect(page.locator(".range")).toContainText("Span");
  const shown = page.locator(".plot").first().locator(".statistics");
  const { head, rows } = await csv(page);
  expect(head).toContain("error.position [mm]");
  expect(rows.length).toBeGreaterThan(40);
  expect(rows.length).toBeLessThan(60);
  const values = rows.map((row) => row[1]);
  const mean = values.reduce((sum, x) => sum + x, 0) / values.length;
  const told = async (name: string) => Number(await shown.locator(`div:has(abbr:text-is("${name}")) dd`).textContent());
  await expect.poll(() => told("n")).toBe(values.length);
  expect(Math.abs((await told("mean")) - mean)).toBeLessThan(0.01 * mean);
  expect(Math.abs((await told("max")) - Math.max(...values))).toBeLessThan(0.01 * Math.max(...values));
});

test("the largest value is gone to by a click", async ({ page }) => {
  await open(page, "spin.mcap");
  const { rows } = await csv(page);
  const worst = rows.reduce((best, row, i) => (row[1] > rows[best][1] ? i : best), 0);
  await page.locator(".plot").first().getByTitle("Go to the largest value shown").click();
  await expect.poll(() => frameOf(page)).toBe(worst);
});

test("plots are zoomed with the wheel, moved with Shift, and shown whole by a double click; a click sets the time", async ({ page }) => {
  await open(page, "spin.mcap");
  const range = page.locator(".range");
  const whole = await range.textContent();
  const box = (await page.locator(".plot .u-over").first().boundingBox())!;
  const middle = { x: box.x + box.width / 2, y: box.y + box.height / 2 };
  await page.mouse.move(middle.x, middle.y);
  await page.mouse.wheel(0, -500);
  await expect(range).not.toHaveText(whole!);
  const zoomed = await range.textContent();
  await page.keyboard.down("Shift");
  await page.mouse.down();
  await page.mouse.move(middle.x - 60, middle.y, { steps: 3 });
  await page.mouse.up();
  await page.keyboard.up("Shift");
  await expect(range).not.toHaveText(zoomed!);
  await page.mouse.dblclick(middle.x, middle.y);
  await expect(range).toHaveText(whole!);
  const now = (await page.locator(".plot .u-over").first().boundingBox())!;
  await page.mouse.click(now.x + now.width / 2, middle.y);
  expect(Math.abs((await frameOf(page)) - 49.5)).toBeLessThan(4);
});

test("a plot is saved as a picture, and read as a table", async ({ page }) => {
  await open(page, "spin.mcap");
  const download = page.waitForEvent("download");
  await page.locator(".plot").first().getByRole("button", { name: "Save this plot as a PNG picture" }).click();
  const file = await download;
  expect(file.suggestedFilename()).toBe("error.position.png");
  expect(
    readFileSync(await file.path())
      .subarray(1, 4)
      .toString(),
  ).toBe("PNG");
  await page.getByRole("button", { name: "Tables in place of plots" }).click();
  const table = page.locator(".plot").first().locator("table");
  await expect(table.locator("tbody tr")).toHaveCount(100);
  const { rows } = await csv(page);
  const cells = await table.locator("tbody tr").nth(10).locator("td").allTextContents();
  expect(Math.abs(Number(cells[1]) - rows[10][1])).toBeLessThan(1e-3);
});
