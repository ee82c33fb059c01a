// Thresholds on the axis of ranges, tables of campaigns and materials, and the command of what was copied; against the server that flies.
import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { resolve } from "node:path";
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

const table = (page: Page, name: string) => page.locator(".sections").getByRole("button", { name, exact: true });
const mark = (page: Page, name: string) => page.getByRole("slider", { name, exact: true });

for (const theme of ["light", "dark"] as const)
  test(`ranges, ${theme}: a threshold is moved by keys, dragged, and leads to its key`, async ({ page }) => {
    await page.emulateMedia({ colorScheme: theme });
    await design(page, "rendezvous", `ranges_${theme}`);
    await table(page, "scan").click();
    await expect(page.locator(".range-axis")).toHaveCount(0);
    await table(page, "further_sensor.laser_camera").click();
    const upper = mark(page, "further_sensor.laser_camera.use_to_m");
    const before = Number(await upper.getAttribute("aria-valuenow"));
    await upper.press("ArrowLeft");
    await expect(upper).not.toHaveAttribute("aria-valuenow", String(before));
    const after = Number(await upper.getAttribute("aria-valuenow"));
    expect(after).toBeLessThan(before);
    await expect(text(page)).toHaveValue(new RegExp(`use_to_m = ${after}\\b`));
    await screenshot(page, `design-ranges-${theme}`);
    expect(await seriousFindings(page)).toEqual([]);
    const box = (await upper.boundingBox())!;
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    await page.mouse.down();
    await page.mouse.move(box.x - 30, box.y + box.height / 2, { steps: 3 });
    await page.mouse.up();
    await expect.poll(async () => Number(await upper.getAttribute("aria-valuenow"))).toBeLessThan(after);
    await upper.press("Enter");
    await expect(field(page, "further_sensor.laser_camera.use_to_m")).toBeFocused();
  });

test("a copied scenario has a command, which makes the same of the file", async ({ page }) => {
  await design(page, "hubble_tenth", "copied");
  const file = `${process.env.PAGE_LIVE_FOLDER}/copied/missions/hubble_tenth.toml`;
  const before = readFileSync(file, "utf8");
  await table(page, "scenario.spin").click();
  await page.getByRole("button", { name: "Copy scenario.spin" }).click();
  await expect(page.getByRole("dialog").getByLabel("Name")).toBeFocused();
  await page.keyboard.press("Enter");
  await field(page, "scenario.spin_2.frames").fill("77");
  await field(page, "scenario.spin_2.frames").press("Enter");
  const command = page.getByLabel("command of these changes");
  await expect(command).toHaveValue(/ scenario\.spin_2\.frames=77 /);
  const words = await command.inputValue();
  await page.keyboard.press("Control+s");
  await page.getByRole("button", { name: "Save", exact: true }).click();
  await expect(page.locator(".run")).toHaveText("saved");
  const saved = file.replace("hubble_tenth.toml", "saved.toml");
  writeFileSync(saved, readFileSync(file));
  writeFileSync(file, before);
  const top = resolve(process.cwd(), "../..");
  const mdat = resolve(process.env.MDAT ?? `${top}/out/build/mdat/mdat`);
  execFileSync("sh", ["-c", words.replace(/^mdat/, () => mdat)], { cwd: top });
  expect(execFileSync(mdat, ["mission", "diff", file, saved], { cwd: top }).toString()).toBe("no value differs\n");
  await screenshot(page, "design-copied-light");
});

test("a campaign and a material are forms, and what is removed has no command", async ({ page }) => {
  await design(page, "hubble_tenth", "campaigns");
  await table(page, "campaign.montecarlo").click();
  await expect(field(page, "campaign.montecarlo.truth.range_m")).toHaveValue("{ uniform = [2.0, 7.0] }");
  await expect(field(page, "campaign.montecarlo.criteria.accurate.at_most")).toHaveValue("5");
  await field(page, "campaign.montecarlo.truth.range_m").fill("{ uniform = [2.5, 6] }");
  await field(page, "campaign.montecarlo.truth.range_m").press("Enter");
  await expect(text(page)).toHaveValue(/range_m = \{ uniform = \[2\.5, 6\] \}/);
  await expect(page.locator(".problems")).toHaveCount(0);
  await screenshot(page, "design-campaign-light");
  await page.getByRole("button", { name: "Add a table" }).click();
  await page.getByRole("dialog").getByLabel("Table").selectOption("material");
  await page.getByRole("dialog").getByLabel("Name").fill("shell");
  await page.keyboard.press("Enter");
  await field(page, "material.shell.parts").fill("*");
  await field(page, "material.shell.parts").press("Enter");
  await field(page, "material.shell.preset").selectOption("mli");
  await expect(text(page)).toHaveValue(/\[material\.shell\]\nparts = "\*"\npreset = "mli"/);
  await expect(page.locator(".problems")).toHaveCount(0);
  await page.getByRole("button", { name: "Remove material.shell" }).click();
  await table(page, "campaign.montecarlo").click();
  await page.getByRole("button", { name: "Remove campaign.montecarlo" }).click();
  await expect(page.locator(".design-foot")).toContainText("no command does that");
});
