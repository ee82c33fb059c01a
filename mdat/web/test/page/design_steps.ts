// Steps in the editor that several tests of the page take.
import type { Page } from "@playwright/test";
import { expect } from "./support.ts";

export const text = (page: Page) => page.getByRole("textbox", { name: "The mission's text" });
export const field = (page: Page, key: string) => page.locator(`[id="field-${key}"]`);

/** Opens a copy of its own of a shipped mission. */
export async function designCopy(page: Page, mission: string, folder: string): Promise<void> {
  await page.getByRole("region", { name: "Design" }).getByRole("link", { name: mission, exact: true }).click();
  await page.getByLabel("Folder").fill(folder);
  await page.getByRole("button", { name: "Copy", exact: true }).click();
  await expect(page.getByRole("heading", { level: 1 })).toHaveText(`${folder}/missions/${mission}.toml`);
}
