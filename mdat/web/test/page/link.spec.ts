// A component elsewhere: the page connects to it, watches it and commands it. It is mdat run --link, on the loopback address.
import type { Page } from "@playwright/test";
import { screenshot } from "./pictures.ts";
import { emptyFolder, flyLinked, type Started, serve } from "./server.ts";
import { drawn, expect, frameOf, seriousFindings, test } from "./support.ts";

test.describe.configure({ mode: "serial" });
test.setTimeout(300_000);

let component: Started;
let server: Started;
let onlooker: Started;
/** Tests that run beside these have folders of their own. */
const own = (name: string): string => emptyFolder(`${name}-${process.env.TEST_WORKER_INDEX}`);
const linkOf = ({ line }: Started): string => line.replace(/^.* by /, "");

test.beforeAll(async () => {
  component = await flyLinked(own("link-run"));
  server = await serve(own("link"), ["--allow-commands"]);
  onlooker = await serve(own("link-watch"));
});

test.afterAll(() => {
  for (const each of [component, server, onlooker]) each?.process.kill("SIGINT");
});

async function connect(page: Page, to: Started, mission = "hubble_tenth"): Promise<void> {
  await page.goto(to.line);
  await page.getByLabel("Address").fill(linkOf(component));
  await page.getByLabel("It flies").selectOption(mission);
  await page.getByRole("button", { name: "Connect" }).click();
  await expect(page.locator(".live-mark")).toHaveText("Live");
  await expect(page.locator(".scene-canvas[data-frame]")).toBeAttached({ timeout: 90_000 });
}

async function disconnect(page: Page): Promise<void> {
  await page.getByRole("button", { name: "Disconnect" }).click();
  await expect(page.getByText("The connection has ended.")).toBeVisible();
}

async function choose(page: Page, name: string): Promise<void> {
  await page.getByLabel("Filter commands").fill(name);
  await page.getByRole("group", { name: "Commands", exact: true }).getByRole("button", { name, exact: true }).click();
}

const newest = (page: Page) => page.getByRole("list", { name: "Commands that were given" }).locator("li").first();

test("a component is connected, followed, and is a recording when it is let go", async ({ page }) => {
  await page.goto(server.line);
  await page.getByLabel("Address").fill("udp:/somewhere");
  await expect(page.getByRole("alert")).toContainText("An address is udp://HOST:PORT");
  await expect(page.getByRole("button", { name: "Connect" })).toBeDisabled();
  await page.getByLabel("Address").fill(linkOf(component));
  await expect(page.getByLabel("command of the connection")).toHaveValue(/^mdat monitor udp:.* --record component-link\.mcap --live$/);
  await connect(page, server);
  const first = await frameOf(page);
  await expect.poll(() => frameOf(page)).toBeGreaterThan(first + 3);
  await expect(page.locator(".live-health")).toContainText("packets/s, none missing");
  await expect(page.locator(".verdict .chip").first()).toBeVisible();
  await expect(page.getByText("A link carries no scans.")).toBeVisible();
  await page.keyboard.press("Space");
  await expect(page.getByText("A component keeps its own pace.")).toBeVisible();
  await page.keyboard.press("Home");
  await drawn(page, 0);
  await page.getByRole("button", { name: "Back to now" }).click();
  await disconnect(page);
  await page.getByRole("link", { name: "MDAT" }).click();
  await page.getByRole("link", { name: "hubble_tenth-link.mcap" }).click();
  await expect(page.locator(".timeline .of")).toBeVisible();
});

test("a command is sent by a form, and the page tells what became of it", async ({ page }) => {
  await connect(page, server);
  await page.getByRole("button", { name: "Commands" }).click();
  await page.getByLabel("Filter commands").fill("safe");
  await expect(page.getByRole("group", { name: "Commands", exact: true }).getByRole("button")).toHaveText(["set_mode"]);
  await choose(page, "set_structure_period");
  await expect(page.getByRole("button", { name: "Send" })).toBeDisabled();
  await page.getByLabel("structure", { exact: true }).selectOption("health");
  await page.getByLabel("period_frames", { exact: true }).fill("1.5");
  await expect(page.getByText(/expected: whole number/)).toBeVisible();
  await page.getByLabel("period_frames", { exact: true }).fill("5");
  await expect(page.getByLabel("command line of the command")).toHaveValue(
    `mdat command set_structure_period structure=health period_frames=5 --to ${linkOf(component)}`,
  );
  await page.getByRole("button", { name: "Send" }).click();
  await expect(newest(page)).toContainText("set_structure_period period_frames=5 structure=health — executed");
  await choose(page, "save_parameters");
  await page.getByRole("button", { name: "Send" }).click();
  await expect(newest(page)).toContainText(/save_parameters — accepted, but not carried out: .+/);
  await page.keyboard.press("Escape");
  await disconnect(page);
});

test("a hazardous command is armed and fired by two clicks, and the component goes to safe by a form", async ({ page }) => {
  await connect(page, server);
  await page.getByRole("button", { name: "Commands" }).click();
  await choose(page, "enable_laser");
  await expect(page.getByRole("button", { name: "2. Fire" })).toBeDisabled();
  await page.getByRole("button", { name: "1. Arm" }).click();
  await expect(newest(page)).toContainText("arm enable_laser — executed");
  await expect(page.getByText(/Armed: \d+ s left to fire\./)).toBeVisible();
  await page.getByRole("button", { name: "2. Fire" }).click();
  await expect(newest(page)).toContainText(/^enable_laser — /);
  await expect(page.getByRole("button", { name: "2. Fire" })).toBeDisabled();
  await choose(page, "set_mode");
  await page.getByLabel("mode", { exact: true }).selectOption("safe");
  await page.getByRole("button", { name: "Send" }).click();
  await expect(newest(page)).toContainText("set_mode mode=safe — executed");
  await page.keyboard.press("Escape");
  await expect(page.locator(".verdict .chip").nth(1)).toHaveText("safe");
  await disconnect(page);
});

test("what nobody allowed is not sent, and the form says how it is: by the keyboard alone, of a mission that is not known", async ({
  page,
}) => {
  await page.goto(onlooker.line);
  await page.getByLabel("Address").focus();
  await page.keyboard.type(linkOf(component));
  await page.keyboard.press("Enter");
  await expect(page.locator(".live-mark")).toHaveText("Live");
  await expect(page.locator(".verdict .chip").first()).toBeVisible();
  await page.getByRole("button", { name: "Commands" }).focus();
  await page.keyboard.press("Enter");
  await expect(page.getByLabel("Filter commands")).toBeVisible();
  while (!(await page.getByLabel("Filter commands").evaluate((field) => field === document.activeElement)))
    await page.keyboard.press("Tab");
  await page.keyboard.type("ping");
  await page.keyboard.press("Tab");
  await page.keyboard.press("Enter");
  await expect(page.getByText("Start it with mdat serve --allow-commands")).toBeVisible();
  await expect(page.getByRole("button", { name: "Send" })).toBeDisabled();
  await screenshot(page, "commands-refused-light");
  await page.keyboard.press("Escape");
  await page.getByRole("button", { name: "Disconnect" }).focus();
  await page.keyboard.press("Enter");
  await expect(page.getByText("The connection has ended.")).toBeVisible();
});

test("a component that stops makes the data stale", async ({ page }) => {
  await connect(page, server);
  component.process.kill("SIGSTOP");
  try {
    await expect(page.getByText("The data are stale.")).toBeVisible();
    await expect(page.getByText(/No packet has come for \d+ s\. See whether the component runs/)).toBeVisible();
    await expect(page.locator(".chart-nothing:visible")).toHaveText("No value in the time that is shown.");
    await screenshot(page, "link-stale-light");
  } finally {
    component.process.kill("SIGCONT");
  }
  await expect(page.getByText("The data are stale.")).toHaveCount(0);
  await disconnect(page);
});

test("nobody at an address is told, and another one can be tried", async ({ page }) => {
  await page.goto(server.line);
  await page.getByLabel("Address").fill("tcp://127.0.0.1:1");
  await page.getByRole("button", { name: "Connect" }).click();
  await expect(page.getByRole("alert")).toContainText("nobody answers: Connection refused");
  await expect(page.getByRole("button", { name: "Connect" })).toBeVisible();
});

for (const theme of ["light", "dark"] as const)
  test(`a link, ${theme}: axe finds nothing serious, at the start, connected and commanding`, async ({ page }) => {
    await page.emulateMedia({ colorScheme: theme });
    await page.goto(server.line);
    await page.getByLabel("Address").fill(linkOf(component));
    await screenshot(page, `connect-${theme}`);
    expect(await seriousFindings(page)).toEqual([]);
    await connect(page, server);
    const close = page.getByRole("button", { name: "Close the first steps" });
    if (await close.isVisible()) await close.click();
    await screenshot(page, `link-${theme}`);
    expect(await seriousFindings(page)).toEqual([]);
    await page.getByRole("button", { name: "Commands" }).click();
    await choose(page, "enable_laser");
    await page.getByRole("button", { name: "1. Arm" }).click();
    await expect(newest(page)).toContainText("executed");
    await screenshot(page, `commands-${theme}`);
    expect(await seriousFindings(page)).toEqual([]);
    await choose(page, "offer_start");
    await screenshot(page, `commands-offer-${theme}`);
    await page.keyboard.press("Escape");
    await disconnect(page);
  });
