import { expect, open, test } from "./support.ts";

test.use({ expected: { pattern: /Failed to load resource|ERR_/ } });

test("a server that is gone is told, with what helps", async ({ page }) => {
  await page.getByRole("link", { name: "spin.mcap" }).waitFor();
  await page.route("**/api/**", (route) => route.abort());
  await page.getByRole("link", { name: "spin.mcap" }).click();
  await expect(page.getByRole("alert")).toContainText("The server does not answer. See whether mdat serve still runs");
  await page.getByRole("button", { name: "Close the message" }).click();
  await expect(page.getByRole("alert")).toHaveCount(0);
});

test.describe("without the token", () => {
  // The socket of the live run is refused as well, if the page opens it before it is told: the browser says so by itself.
  const refused = /WebSocket connection to '[^']*\/api\/live\/socket' failed: HTTP Authentication failed/;
  test.use({ expected: { pattern: new RegExp(`Failed to load resource|${refused.source}`) } });

  test("a browser is told to open the printed address", async ({ page, context }) => {
    await page.getByRole("link", { name: "spin.mcap" }).waitFor();
    await context.clearCookies();
    await page.getByRole("link", { name: "spin.mcap" }).click();
    await expect(page.getByRole("alert")).toBeVisible();
    await expect(page.getByRole("alert")).toContainText(/address|token/);
  });
});

test("an address of a recording that is not there leads back to the list", async ({ page }) => {
  await page.goto("/#/r/0123456789abcdef");
  await expect(page.getByRole("alert")).toBeVisible();
  await expect(page.getByRole("heading", { level: 1 })).toHaveText("Fly and replay");
});

test("a failure while a recording is open leaves the rest usable", async ({ page }) => {
  await open(page, "spin.mcap", 10);
  await page.route("**/statistics*", (route) =>
    route.fulfill({ status: 500, json: { error: "The disk is gone.", remedy: "Plug it in." } }),
  );
  await page.keyboard.press("[");
  await page.keyboard.press("]");
  await page.keyboard.press("ArrowRight");
  await page.keyboard.press("[");
  await expect(page.getByRole("alert")).toContainText("The disk is gone. Plug it in.");
  await expect(page.locator('.scene-canvas[data-frame="11"]')).toBeAttached();
});

test("a cut recording says what is missing, and shows the rest", async ({ page }) => {
  await open(page, "cut.mcap", 5);
  await expect(page.locator(".banner")).toContainText("This recording is damaged.");
});

test("a file that is no recording says so, and the list stays", async ({ page }) => {
  await page.getByText("letter.mcap").click();
  await expect(page.getByText(/letter\.mcap.*(no recording|not|MCAP)/).last()).toBeVisible();
  await expect(page.getByRole("heading", { level: 1 })).toHaveText("Fly and replay");
});
