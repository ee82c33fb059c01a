import { drawn, expect, frameOf, open, test } from "./support.ts";

test("space plays and pauses; the frame, the picture and the address follow", async ({ page }) => {
  await open(page, "spin.mcap");
  await page.keyboard.press("Space");
  await expect.poll(() => frameOf(page)).toBeGreaterThan(4);
  await page.keyboard.press("Space");
  const frame = await frameOf(page);
  await drawn(page, frame);
  await expect(page).toHaveURL(new RegExp(`frame=${frame}$`));
  await page.reload();
  await drawn(page, frame);
});

test("arrows go by a frame, with Shift by ten, Home and End to the ends", async ({ page }) => {
  await open(page, "spin.mcap", 50);
  for (const [key, frame] of [
    ["ArrowRight", 51],
    ["ArrowLeft", 50],
    ["Shift+ArrowRight", 60],
    ["Shift+ArrowLeft", 50],
    ["End", 99],
    ["ArrowRight", 99],
    ["Home", 0],
  ] as const) {
    await page.keyboard.press(key);
    expect(await frameOf(page), key).toBe(frame);
  }
  await drawn(page, 0);
});

test("J, K and L play in reverse, pause and play, faster with each stroke", async ({ page }) => {
  await open(page, "spin.mcap", 60);
  await page.keyboard.press("j");
  await expect.poll(() => frameOf(page)).toBeLessThan(58);
  await page.keyboard.press("k");
  const frame = await frameOf(page);
  await page.keyboard.press("l");
  await page.keyboard.press("l");
  await page.keyboard.press("l");
  await expect(page.getByLabel("Speed")).toHaveValue("4");
  await expect.poll(() => frameOf(page)).toBeGreaterThan(frame + 10);
  await page.keyboard.press("k");
  await page.keyboard.press(",");
  await expect(page.getByLabel("Speed")).toHaveValue("2");
});

test("a span is looped", async ({ page }) => {
  await open(page, "spin.mcap", 20);
  await page.keyboard.press("[");
  await page.keyboard.press("Shift+ArrowRight");
  await page.keyboard.press("]");
  await page.keyboard.press("\\");
  await expect(page.locator(".track .span.looped")).toBeVisible();
  await page.getByLabel("Speed").selectOption("8");
  await page.locator(".panel-why .scroll").focus();
  await page.keyboard.press("Space");
  const seen = new Set<number>();
  await expect.poll(async () => seen.add(await frameOf(page)).size, { intervals: [30], timeout: 90_000 }).toBeGreaterThan(4);
  await page.waitForTimeout(500);
  seen.add(await frameOf(page));
  await page.keyboard.press("k");
  expect(Math.min(...seen)).toBeGreaterThanOrEqual(20);
  expect(Math.max(...seen)).toBeLessThanOrEqual(30);
});

test("jumps go to wrong and refused poses and to events, and say where there is none", async ({ page }) => {
  await open(page, "turned.mcap", 0);
  const columns = await page.request.get(page.url().replace(/#\/r\/([0-9a-f]+).*/, "api/recordings/$1/frames?columns=valid,wrong"));
  const bytes = await columns.body();
  const frames = bytes.length / 8;
  const wrong = (i: number) => bytes.readFloatLE(4 * i) === 1 && bytes.readFloatLE(4 * (frames + i)) === 1;
  const refused = (i: number) => bytes.readFloatLE(4 * i) === 0;
  const next = (from: number, fits: (i: number) => boolean) => Array.from({ length: frames }, (_, i) => i).find((i) => i > from && fits(i));
  await page.keyboard.press("w");
  expect(await frameOf(page)).toBe(next(0, wrong));
  await expect(page.locator(".chip-wrong")).toBeVisible();
  const at = await frameOf(page);
  await page.keyboard.press("r");
  const found = next(at, refused);
  expect(await frameOf(page)).toBe(found);
  await expect(page.locator(".chip-refused")).toBeVisible();
  await page.keyboard.press("End");
  await page.keyboard.press("e");
  await expect(page.getByRole("status").filter({ hasText: /No event after frame/ })).toBeVisible();
  await page.keyboard.press("Shift+e");
  expect(await frameOf(page)).toBeLessThan(frames - 1);
});

test("a click on the time line sets the time, and the wheel zooms into it", async ({ page }) => {
  await open(page, "spin.mcap", 0);
  const track = page.getByRole("slider", { name: "Time" });
  const box = (await track.boundingBox())!;
  await page.mouse.click(box.x + box.width / 2, box.y + 20);
  const frame = await frameOf(page);
  expect(Math.abs(frame - 49.5)).toBeLessThan(3);
  await drawn(page, frame);
  const range = page.locator(".panel-plots .range");
  const all = await range.textContent();
  await page.mouse.wheel(0, -400);
  await expect(range).not.toHaveText(all!);
  await page.keyboard.press("0");
  await expect(range).toHaveText(all!);
});

test("a frame is gone to by its number", async ({ page }) => {
  await open(page, "spin.mcap", 0);
  await page.keyboard.press("g");
  await page.keyboard.press("Control+a");
  await page.keyboard.type("37");
  await page.keyboard.press("Enter");
  await drawn(page, 37);
});
