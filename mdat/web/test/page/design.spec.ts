// A mission that is copied, changed by its form and by its text, and saved; against the server that flies.
import { readFileSync, writeFileSync } from "node:fs";
import type { Page } from "@playwright/test";
import { designCopy, field, text } from "./design_steps.ts";
import { screenshot } from "./pictures.ts";
import { expect, seriousFindings, test } from "./support.ts";

test.describe.configure({ mode: "serial" });

const fileOf = (folder: string): string => `${process.env.PAGE_LIVE_FOLDER}/${folder}/missions/hubble_tenth.toml`;

/** Opens a copy of its own of the tenth-scale Hubble. */
async function design(page: Page, folder: string): Promise<void> {
  await page.goto(process.env.PAGE_LIVE_ADDRESS!);
  await designCopy(page, "hubble_tenth", folder);
}

test("a value of the form changes its span of the text, is taken back, and is saved behind a look at the lines", async ({ page }) => {
  await design(page, "by_form");
  const before = await text(page).inputValue();
  await field(page, "scan.points").fill("512");
  await field(page, "scan.points").press("Enter");
  await expect(text(page)).toHaveValue(before.replace("points = 1024", "points = 512"));
  await expect(page.getByLabel("command of these changes")).toHaveValue(/^mdat mission set .*hubble_tenth\.toml scan\.points=512$/);
  await page.getByRole("button", { name: "Undo" }).click();
  await expect(text(page)).toHaveValue(before);
  await expect(field(page, "scan.points")).toHaveValue("1024");
  await page.getByRole("button", { name: "Do again" }).click();
  await field(page, "scan.pattern").selectOption("lissajous");
  await expect(text(page)).toHaveValue(/pattern = "lissajous"/);
  await page.keyboard.press("Control+s");
  await expect(page.getByRole("dialog")).toContainText("+ points = 512");
  await screenshot(page, "design-save-light");
  await page.getByRole("button", { name: "Save", exact: true }).click();
  await expect(page.locator(".run")).toHaveText("saved");
  expect(readFileSync(fileOf("by_form"), "utf8")).toBe(await text(page).inputValue());
});

test("a wrong value is told at its key, at its line and in the list, and cannot be saved", async ({ page }) => {
  await design(page, "wrong");
  await field(page, "scan.points").fill("5");
  await field(page, "scan.points").press("Enter");
  await expect(page.locator(".field-row .bad")).toContainText("expected a whole number from 64 to 4096");
  await expect(page.locator(".gutter .bad-line")).toHaveCount(1);
  await expect(page.locator(".problems")).toContainText("1 problem");
  await expect(page.getByRole("button", { name: "Save …" })).toBeDisabled();
  await screenshot(page, "design-problem-light");
  await text(page).fill((await text(page).inputValue()).replace("points = 5", "points = 640"));
  await expect(page.locator(".problems")).toHaveCount(0);
  await expect(field(page, "scan.points")).toHaveValue("640");
});

test("a file that was changed on disk meanwhile is not overwritten", async ({ page, expected }) => {
  expected.pattern = /409/;
  await design(page, "meanwhile");
  const other = `# from elsewhere\n${readFileSync(fileOf("meanwhile"), "utf8")}`;
  writeFileSync(fileOf("meanwhile"), other);
  await field(page, "scan.points").fill("512");
  await field(page, "scan.points").press("Enter");
  await page.keyboard.press("Control+s");
  await page.getByRole("button", { name: "Save", exact: true }).click();
  await expect(page.getByRole("alert")).toContainText("file was changed on disk meanwhile");
  expect(readFileSync(fileOf("meanwhile"), "utf8")).toBe(other);
});

test("keys are found by words, and a place leads to its line", async ({ page }) => {
  await design(page, "found");
  await page.keyboard.press("/");
  await expect(page.getByLabel("Find a key")).toBeFocused();
  await page.keyboard.type("rays scan.points");
  await expect(page.locator(".field-row")).toHaveCount(1);
  await page.getByRole("button", { name: /^line \d+/ }).click();
  const chosen = await text(page).evaluate((area: HTMLTextAreaElement) => area.value.slice(area.selectionStart, area.selectionEnd));
  expect(chosen).toContain("points = 1024");
});

for (const theme of ["light", "dark"] as const)
  test(`design, ${theme}: axe finds nothing serious`, async ({ page }) => {
    await page.emulateMedia({ colorScheme: theme });
    await design(page, `axe_${theme}`);
    await page.getByRole("button", { name: "scenario.spin" }).click();
    await expect(field(page, "scenario.spin.frames")).toBeVisible();
    await screenshot(page, `design-${theme}`);
    expect(await seriousFindings(page)).toEqual([]);
  });
