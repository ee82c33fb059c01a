// Tables of a mission that are added, copied and removed from the form; against the server that flies.
import type { Page } from "@playwright/test";
import { designCopy, field, text } from "./design_steps.ts";
import { screenshot } from "./pictures.ts";
import { expect, seriousFindings, test } from "./support.ts";

/** Opens a copy of its own of a shipped mission, without the preview. */
async function design(page: Page, mission: string, folder: string): Promise<void> {
  await page.goto(process.env.PAGE_LIVE_ADDRESS!);
  await page.evaluate(() => localStorage.setItem("mdat.design-preview", "false"));
  await page.reload();
  await designCopy(page, mission, folder);
}

test("a scenario is copied, changed, removed and brought back; a node stands below its parent", async ({ page }) => {
  await page.emulateMedia({ colorScheme: "dark" });
  await design(page, "rendezvous", "tables");
  const before = await text(page).inputValue();
  await expect(page.locator(".sections .node-depth-1").first()).toHaveText("node.arrays");
  const first = page.locator(".sections button", { hasText: "scenario." }).first();
  const name = (await first.textContent())!.trim();
  await first.click();
  await page.getByRole("button", { name: `Copy ${name}` }).press("Enter");
  await page.getByRole("dialog").getByLabel("Name").fill("mine");
  await page.keyboard.press("Enter");
  await expect(text(page)).toHaveValue(/\[scenario\.mine\]/);
  await expect(field(page, "scenario.mine.frames")).toHaveValue("1200");
  await expect(page.locator(".problems")).toHaveCount(0);
  await field(page, "scenario.mine.frames").fill("77");
  await field(page, "scenario.mine.frames").press("Enter");
  await expect(text(page)).toHaveValue(/frames = 77/);
  expect(await seriousFindings(page)).toEqual([]);
  await screenshot(page, "tables-copied-dark");
  await page.getByRole("button", { name: "Remove scenario.mine" }).press("Enter");
  await expect(text(page)).toHaveValue(before);
  await page.getByRole("button", { name: "Undo" }).click();
  await expect(text(page)).toHaveValue(/frames = 77/);
});

test("a table is added with the keys that it must have; a name that is taken is told", async ({ page }) => {
  await design(page, "rendezvous", "tables_added");
  await page.getByRole("button", { name: "Add a table" }).press("Enter");
  const dialog = page.getByRole("dialog");
  await dialog.getByLabel("Table").selectOption("node");
  await dialog.getByLabel("Name").fill("chaser");
  await expect(dialog.getByRole("status")).toHaveText("chaser is there already.");
  await screenshot(page, "tables-add-light");
  await dialog.getByLabel("Name").fill("camera_mount");
  await page.keyboard.press("Enter");
  await expect(text(page)).toHaveValue(/\n\[node\.camera_mount\]\n$/);
  await field(page, "node.camera_mount.parent").fill("chaser");
  await field(page, "node.camera_mount.parent").press("Enter");
  await expect(text(page)).toHaveValue(/\n\[node\.camera_mount\]\nparent = "chaser"\n$/);
  await expect(page.locator(".sections .node-depth-1", { hasText: "camera_mount" })).toBeVisible();
});
