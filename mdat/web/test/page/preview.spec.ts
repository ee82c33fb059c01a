// The preview of the editor: the target and a scan of the text as it is edited; against the server that flies.
import { readFileSync } from "node:fs";
import type { Page } from "@playwright/test";
import { designCopy, field, text } from "./design_steps.ts";
import { screenshot } from "./pictures.ts";
import { differing, expect, pictureOf, seriousFindings, test } from "./support.ts";

const counts = (page: Page) => page.locator(".preview-counts");
const canvas = ".panel-preview .scene-canvas";

/** Opens a copy of its own of the tenth-scale Hubble, and waits until its target is drawn. */
async function design(page: Page, folder: string): Promise<void> {
  await page.goto(process.env.PAGE_LIVE_ADDRESS!);
  await designCopy(page, "hubble_tenth", folder);
  await expect(page.locator(`${canvas}[data-surface]`)).toBeAttached();
}

async function set(page: Page, key: string, value: string): Promise<void> {
  await field(page, key).fill(value);
  await field(page, key).press("Enter");
}

/** The picture differs from an earlier one by more than rounding. */
async function expectChanged(page: Page, before: string): Promise<void> {
  await expect.poll(async () => differing(page, before, await pictureOf(page, canvas))).toBeGreaterThan(100);
}

test("target, pattern and field of view follow the form, without saving; a problem leaves the last picture", async ({ page }) => {
  await design(page, "preview");
  await expect(counts(page)).toContainText("1024 rays");
  const file = readFileSync(`${process.env.PAGE_LIVE_FOLDER}/preview/missions/hubble_tenth.toml`, "utf8");
  const first = await pictureOf(page, canvas);
  await set(page, "scan.points", "512");
  await expect(counts(page)).toContainText("512 rays");
  await expectChanged(page, first);
  const fewer = await pictureOf(page, canvas);
  await field(page, "scan.pattern").selectOption("raster");
  await expectChanged(page, fewer);
  const raster = await pictureOf(page, canvas);
  await page.getByRole("button", { name: "sensor", exact: true }).click();
  await set(page, "sensor.fov_half_x_deg", "6");
  await expectChanged(page, raster);
  await screenshot(page, "preview-raster-light");
  await page.getByLabel("Scenario of the preview").selectOption("paper");
  await page.getByLabel("Range of the preview").selectOption({ index: 1 });
  await expect(counts(page)).toContainText(/at 3(\.\d+)? m/);
  const last = await counts(page).textContent();
  await page.getByRole("button", { name: "scan", exact: true }).click();
  await set(page, "scan.points", "5");
  await expect(page.locator(".older")).toContainText("The picture is of an older text.");
  await expect(page.locator(".older")).toContainText("scan.points");
  await expect(counts(page)).toHaveText(last!);
  await screenshot(page, "preview-older-light");
  expect(readFileSync(`${process.env.PAGE_LIVE_FOLDER}/preview/missions/hubble_tenth.toml`, "utf8")).toBe(file);
});

test("a further sensor scans from its own place, and the scenario that is designed is the one that is drawn", async ({ page }) => {
  await page.goto(process.env.PAGE_LIVE_ADDRESS!);
  await designCopy(page, "hubble", "preview_mast");
  const nodes = '\n[node.body]\ntarget = true\n[node.head]\nsensor = true\n[node.mast]\nparent = "head"\nposition_m = [0.6, 0, 0]\n';
  const written = (await text(page).inputValue()).replace("[further_sensor.laser_camera]", '$&\nnode = "mast"');
  await text(page).fill(`${written}${nodes}\n[scenario.near]\nranges_m = [6.0]\nframes = 3\n`);
  await page.locator(".sections").getByRole("button", { name: "scenario.near" }).click();
  await expect(page.getByLabel("Scenario of the preview")).toHaveValue("near");
  await expect(counts(page)).toContainText("laser_camera at 6.000 m, from 0.6, 0, 0 m (right, down, ahead)");
  await expect(page.locator(`${canvas}[data-place="0.6 0 0"]`)).toBeAttached();
  await screenshot(page, "preview-mast-light");
});

test("by keys: the view turns, goes nearer and fits; the preview is put away, and stays so", async ({ page }) => {
  await page.emulateMedia({ colorScheme: "dark" });
  await design(page, "preview_keys");
  await expect(counts(page)).toContainText("1024 rays");
  expect(await seriousFindings(page)).toEqual([]);
  await screenshot(page, "preview-dark");
  await page.getByRole("application").focus();
  const before = await pictureOf(page, canvas);
  await page.keyboard.press("ArrowRight");
  await expectChanged(page, before);
  const turned = await pictureOf(page, canvas);
  await page.keyboard.press("PageUp");
  await expectChanged(page, turned);
  await page.getByRole("button", { name: "Preview", exact: true }).press("Enter");
  await expect(page.locator(".panel-preview")).toHaveCount(0);
  await page.reload();
  await expect(page.getByRole("textbox", { name: "The mission's text" })).toBeVisible();
  await expect(page.locator(".panel-preview")).toHaveCount(0);
});
