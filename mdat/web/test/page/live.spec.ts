// A run that is started, paced and stopped from the page, against a server of its own: it flies one run at a time.
import type { Page } from "@playwright/test";
import { screenshot } from "./pictures.ts";
import { drawn, expect, frameOf, seriousFindings, test } from "./support.ts";

test.describe.configure({ mode: "serial" });
test.setTimeout(180_000);

const bar = (page: Page) => page.getByRole("region", { name: "Live" });
const framesSoFar = async (page: Page): Promise<number> => Number((await page.locator(".live-count").textContent())!.split(" ")[0]);

test.beforeEach(async ({ page }) => {
  await page.goto(process.env.PAGE_LIVE_ADDRESS!);
  await expect(page.getByRole("button", { name: "Fly live" })).toBeEnabled();
});

/** Starts a run, and waits until its view follows it. At a quarter of real time it flies for 80 s, longer than a busy machine needs to look at it. */
async function fly(page: Page, scenario = "spin", pace = "0.25"): Promise<void> {
  await page.getByRole("combobox", { name: "Mission" }).selectOption("hubble_tenth");
  await page.getByLabel("Scenario").selectOption(scenario);
  await page.getByLabel("Pace of the run").selectOption(pace);
  await page.getByRole("button", { name: "Fly live" }).click();
  await expect(page.locator(".live-mark")).toHaveText("Live");
  await expect(page.locator(".scene-canvas[data-frame]")).toBeAttached();
}

/** Ends the run, whatever a test left, and waits for its end. */
async function stop(page: Page): Promise<void> {
  await page.getByRole("button", { name: "Stop" }).click();
  await expect(page.getByText("The run is over.")).toBeVisible();
}

test("a run is chosen, started, followed, and is a recording when it is stopped", async ({ page }) => {
  await page.getByLabel("Seed").fill("4");
  await expect(page.getByLabel("command of the live run")).toHaveValue(
    /hubble_tenth\.toml --scenario spin --seed 4 --record .* --live --pace 1$/,
  );
  await fly(page);
  const first = await frameOf(page);
  await expect.poll(() => frameOf(page)).toBeGreaterThan(first + 3);
  await expect(page.locator(".live-now")).toHaveText("following the newest frame");
  await expect(page.locator(".verdict .chip").first()).toBeVisible();
  await expect(page.locator(".plot .chart canvas").first()).toBeVisible();
  await expect(page.locator(".run")).toContainText("seed 4");
  await stop(page);
  const frames = Number(
    await page
      .locator(".timeline .of")
      .textContent()
      .then((text) => text!.replace(/\D/g, "")),
  );
  expect(frames).toBeGreaterThan(3);
  await drawn(page, frames - 1);
  await page.getByRole("link", { name: "MDAT" }).click();
  await page.getByRole("link", { name: "hubble_tenth-spin-live.mcap" }).click();
  await expect(page.locator(".timeline .of")).toHaveText(`of ${frames}`);
  await expect(bar(page)).toHaveCount(0);
});

/** Frames that were on their way when the run was paused come late on a busy machine: the count once a second has brought none. */
async function framesOnceStill(page: Page): Promise<number> {
  let last = await framesSoFar(page);
  const isStill = async () => {
    const before = last;
    await page.waitForTimeout(1000);
    last = await framesSoFar(page);
    return last === before;
  };
  await expect.poll(isStill).toBe(true);
  return last;
}

test("a paused run stands still, goes by single frames, and goes on", async ({ page }) => {
  await fly(page);
  await page.keyboard.press("Space");
  await expect(page.locator(".live-mark")).toHaveText("Paused");
  const before = await framesOnceStill(page);
  await page.waitForTimeout(1000);
  expect(await framesSoFar(page)).toBe(before);
  await page.getByRole("button", { name: "Fly one frame" }).click();
  await expect.poll(() => framesSoFar(page)).toBe(before + 1);
  await page.keyboard.press("ArrowRight");
  await expect.poll(() => framesSoFar(page)).toBe(before + 2);
  await drawn(page, before + 1);
  await page.getByRole("button", { name: "Go on" }).click();
  await expect.poll(() => framesSoFar(page)).toBeGreaterThan(before + 4);
  await stop(page);
});

test("going back in time leaves the run, and a button returns to now", async ({ page }) => {
  await fly(page);
  await expect.poll(() => framesSoFar(page)).toBeGreaterThan(4);
  await page.keyboard.press("Home");
  await drawn(page, 0);
  const before = await framesSoFar(page);
  await expect.poll(() => framesSoFar(page)).toBeGreaterThan(before + 2);
  expect(await frameOf(page)).toBe(0);
  await page.getByRole("button", { name: "Back to now" }).click();
  await expect(page.locator(".live-now")).toHaveText("following the newest frame");
  await expect.poll(() => frameOf(page)).toBeGreaterThan(before + 2);
  await stop(page);
});

test("the pace is chosen, and faster and slower by keys", async ({ page }) => {
  await fly(page, "spin", "0.5");
  await expect(page.getByLabel("Pace of the run")).toHaveValue("0.5");
  await page.keyboard.press(".");
  await expect(page.getByLabel("Pace of the run")).toHaveValue("1");
  await page.keyboard.press(",");
  await expect(page.getByLabel("Pace of the run")).toHaveValue("0.5");
  await page.getByLabel("Pace of the run").selectOption("0");
  await expect(page.getByText("The run is over.")).toBeVisible({ timeout: 120_000 });
  await page.getByRole("button", { name: "Close the message about the run" }).click();
  await expect(page.getByText("The run is over.")).toHaveCount(0);
});

test("data that do not come are called stale, and no longer when they do", async ({ page }) => {
  const server = Number(process.env.PAGE_LIVE_PID);
  await fly(page);
  await expect(page.locator(".live-health")).toContainText("packets/s, none missing");
  await expect(page.getByText("The data are stale.")).toHaveCount(0);
  process.kill(server, "SIGSTOP");
  try {
    await expect(page.getByText("The data are stale.")).toBeVisible();
    await screenshot(page, "live-stale-light");
  } finally {
    process.kill(server, "SIGCONT");
  }
  await expect(page.getByText("The data are stale.")).toHaveCount(0);
  await stop(page);
});

test("a second page sees the run on its start, opens it and stops it", async ({ page, context }) => {
  await fly(page);
  const other = await context.newPage();
  await other.goto(process.env.PAGE_LIVE_ADDRESS!);
  await other.getByRole("link", { name: "Watch" }).click();
  await expect(other.locator(".live-mark")).toHaveText("Live");
  await stop(other);
  await expect(page.getByText("The run is over.")).toBeVisible();
});

test("scenarios of several ranges are not offered, and a wrong seed says what is right", async ({ page }) => {
  const options = await page
    .getByLabel("Scenario")
    .locator("option")
    .evaluateAll((all) => all.map((option) => [(option as HTMLOptionElement).text, (option as HTMLOptionElement).disabled] as const));
  expect(options.some(([, disabled]) => disabled)).toBe(true);
  for (const [text, disabled] of options) expect(/ranges: mdat run alone/.test(text), text).toBe(disabled);
  await page.getByLabel("Seed").fill("-3");
  await expect(page.getByRole("alert")).toContainText("The seed is a whole number from 0 to 4294967295.");
  await expect(page.getByRole("button", { name: "Fly live" })).toBeDisabled();
});

for (const theme of ["light", "dark"] as const)
  test(`live, ${theme}: axe finds nothing serious, running and over`, async ({ page }) => {
    await page.emulateMedia({ colorScheme: theme });
    await screenshot(page, `fly-${theme}`);
    await fly(page);
    await expect.poll(() => framesSoFar(page)).toBeGreaterThan(6);
    const close = page.getByRole("button", { name: "Close the first steps" });
    if (await close.isVisible()) await close.click();
    await screenshot(page, `live-${theme}`);
    expect(await seriousFindings(page)).toEqual([]);
    await stop(page);
    await screenshot(page, `live-over-${theme}`);
    expect(await seriousFindings(page)).toEqual([]);
  });
