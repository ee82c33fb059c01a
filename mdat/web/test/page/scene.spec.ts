import { readFileSync } from "node:fs";
import { differing, drawings, expect, open, pictureOf, test } from "./support.ts";

test("what is chosen to be shown is in the picture", async ({ page }) => {
  await open(page, "spin.mcap", 30);
  await page.getByTitle("What is shown").click();
  for (const layer of [
    "Target at the estimate",
    "Target at the truth",
    "Points",
    "Rays that missed",
    "Field of view",
    "Scan pattern",
    "Covariance",
  ]) {
    const box = page.getByLabel(layer, { exact: true });
    const before = await pictureOf(page, ".stage");
    await box.click();
    await expect.poll(async () => differing(page, before, await pictureOf(page, ".stage")), { message: layer }).toBeGreaterThan(40);
    await box.click();
  }
});

test("points are coloured by each choice, with a scale of numbers or counts", async ({ page }) => {
  await open(page, "spin.mcap", 30);
  const choice = page.getByLabel("Colour of points", { exact: true });
  const legend = page.locator(".scene-legend");
  for (const [name, words] of [
    ["range", /Range, m/],
    ["sigma", /Sigma of range, mm/],
    ["age", /Age.*, ms/],
    ["state", /return \d+/],
    ["part", /Part/],
    ["residual", /Residual, mm/],
  ] as const) {
    const before = await pictureOf(page, ".scene-canvas");
    await choice.selectOption(name);
    await expect(legend).toContainText(words);
    await expect.poll(async () => differing(page, before, await pictureOf(page, ".scene-canvas")), { message: name }).toBeGreaterThan(100);
  }
});

test("the four cameras see different things, and the sensor's eye looks along the boresight", async ({ page }) => {
  await open(page, "spin.mcap", 30);
  const pictures = [];
  for (const name of ["Target", "Sensor's eye", "Chase", "Free"]) {
    await page.getByRole("button", { name, exact: true }).click();
    await expect(page.getByRole("button", { name, exact: true })).toHaveAttribute("aria-pressed", "true");
    await page.waitForTimeout(150);
    pictures.push(await pictureOf(page, ".scene-canvas"));
  }
  expect(await differing(page, pictures[0], pictures[1])).toBeGreaterThan(2000);
  expect(await differing(page, pictures[1], pictures[2])).toBeGreaterThan(2000);
  await page.keyboard.press("2");
  await page.waitForTimeout(150);
  const eye = await pictureOf(page, ".scene-canvas");
  await page.keyboard.press("Shift+ArrowRight");
  await page.waitForTimeout(400);
  const later = await pictureOf(page, ".scene-canvas");
  expect(await differing(page, eye, later), "the target moves").toBeGreaterThan(100);
  expect(await differing(page, eye, later, 5), "the sensor's view keeps its edges").toBe(0);
});

test("the view is turned by drag and keys, and drawn only when something moves", async ({ page }) => {
  await open(page, "spin.mcap", 30);
  await page.waitForTimeout(500);
  const still = await drawings(page);
  await page.waitForTimeout(1000);
  expect(await drawings(page), "drawings while nothing moves").toBe(still);
  const before = await pictureOf(page, ".scene-canvas");
  const box = (await page.locator(".stage").boundingBox())!;
  await page.mouse.move(box.x + 420, box.y + 150);
  await page.mouse.down();
  await page.mouse.move(box.x + 520, box.y + 180, { steps: 4 });
  await page.mouse.up();
  const dragged = await pictureOf(page, ".scene-canvas");
  expect(await differing(page, before, dragged)).toBeGreaterThan(500);
  await page.keyboard.press("Control+ArrowLeft");
  await page.waitForTimeout(150);
  expect(await differing(page, dragged, await pictureOf(page, ".scene-canvas"))).toBeGreaterThan(300);
});

test("software draws 1024 points while playing and turning", async ({ page }) => {
  await open(page, "spin.mcap", 0);
  await page.getByLabel("Speed").selectOption("8");
  await page.getByRole("button", { name: "Play", exact: true }).click();
  const begin = await drawings(page);
  await page.waitForTimeout(1500);
  const perSecond = ((await drawings(page)) - begin) / 1.5;
  test.info().annotations.push({ type: "figure", description: `${perSecond.toFixed(1)} drawings a second while playing` });
  const turned = await page.evaluate(async () => {
    const canvas = document.querySelector<HTMLCanvasElement>(".scene-canvas")!;
    const begun = performance.now();
    const from = Number(canvas.dataset.drawn);
    for (let i = 0; i < 20; ++i) {
      window.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowRight", ctrlKey: true }));
      await new Promise((resolve) => requestAnimationFrame(resolve));
    }
    return (1000 * (Number(canvas.dataset.drawn) - from)) / (performance.now() - begun);
  });
  test.info().annotations.push({ type: "figure", description: `${turned.toFixed(1)} drawings a second while turning` });
  // How many depends on what else the machine does: the figures are kept in the report.
  expect(Math.min(perSecond, turned)).toBeGreaterThan(0);
});

test("a distance is measured by two clicks, shown beside its line, and undone", async ({ page }) => {
  await open(page, "spin.mcap", 30);
  await page.getByRole("button", { name: "Measure between two points" }).click();
  await expect(page.getByText("choose the first point")).toBeVisible();
  const box = (await page.locator(".stage").boundingBox())!;
  const centre = { x: box.x + box.width / 2, y: box.y + box.height / 2 };
  await page.mouse.click(centre.x, centre.y - 40);
  await expect(page.getByText("Choose the second point")).toBeVisible();
  await page.mouse.click(centre.x, centre.y + 50);
  await expect(page.locator(".label-distance")).toHaveText(/^\d+(\.\d+)? m?m$/);
  const text = (await page.locator(".label-distance").textContent())!;
  await expect(page.locator(".measurements")).toContainText(text);
  await page.keyboard.press("Control+z");
  await expect(page.locator(".label-distance")).toHaveCount(0);
  await page.keyboard.press("Control+Shift+z");
  await expect(page.locator(".label-distance")).toHaveText(text);
});

test("the point under the pointer is told", async ({ page }) => {
  await open(page, "spin.mcap", 30);
  const box = (await page.locator(".stage").boundingBox())!;
  const reading = page.locator(".point-reading");
  for (let i = 0; i < 60 && !(await reading.isVisible()); ++i) await page.mouse.move(box.x + box.width / 2, box.y + 60 + 4 * i);
  await expect(reading).toContainText(/Ray \d+: return, range \d/);
});

test("the view is saved as a picture", async ({ page }) => {
  await open(page, "spin.mcap", 30);
  const download = page.waitForEvent("download");
  await page.getByRole("button", { name: "Save the view as a PNG picture" }).click();
  const file = await download;
  expect(file.suggestedFilename()).toBe("spin.mcap_frame_30.png");
  const bytes = readFileSync(await file.path());
  expect(bytes.subarray(1, 4).toString()).toBe("PNG");
  expect(bytes.length).toBeGreaterThan(10_000);
});
