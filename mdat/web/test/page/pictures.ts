// Where pictures of views are left.
import { join } from "node:path";
import type { Page } from "@playwright/test";
import { OUT } from "../../playwright.config.ts";

export async function screenshot(page: Page, name: string): Promise<void> {
  await page.screenshot({ path: join(OUT, "screenshots", `${name}.png`) });
}
