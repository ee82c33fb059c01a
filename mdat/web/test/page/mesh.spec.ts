// A mesh that is dropped on the page, or chosen by keys, becomes a mission that flies; against a server of its own, which flies one.
import { execFileSync } from "node:child_process";
import { existsSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import type { Page } from "@playwright/test";
import { screenshot } from "./pictures.ts";
import { expect, seriousFindings, test } from "./support.ts";

test.describe.configure({ mode: "serial" });

const FOLDER = (): string => process.env.PAGE_MESH_FOLDER!;
const MDAT = resolve(process.env.MDAT ?? "../../out/build/mdat/mdat");

/** A text STL of boxes, each by its lowest corner and sides, in millimetres. */
function boxes(list: [number[], number[]][]): string {
  const faces = list.flatMap(([low, sides]) => {
    const corner = (i: number) => low.map((x, axis) => x + ((i >> axis) & 1) * sides[axis]);
    const quads = [
      [0, 2, 3, 1],
      [4, 5, 7, 6],
      [0, 1, 5, 4],
      [2, 6, 7, 3],
      [0, 4, 6, 2],
      [1, 3, 7, 5],
    ];
    return quads.flatMap(([a, b, c, d]) => [
      [corner(a), corner(b), corner(c)],
      [corner(a), corner(c), corner(d)],
    ]);
  });
  const facet = (corners: number[][]) =>
    `facet normal 0 0 0\nouter loop\n${corners.map((p) => `vertex ${p.join(" ")}`).join("\n")}\nendloop\nendfacet`;
  return `solid target\n${faces.map(facet).join("\n")}\nendsolid target\n`;
}

/** A body with a wing, a mast and a box that tells its sides apart. */
const SATELLITE = boxes([
  [
    [-700, -500, -400],
    [1400, 1000, 800],
  ],
  [
    [700, -200, -30],
    [1500, 500, 60],
  ],
  [
    [-300, 500, 100],
    [150, 600, 150],
  ],
]);

/** Drops a file on the page as a file manager does. */
async function drop(page: Page, name: string, text: string): Promise<void> {
  const data = await page.evaluateHandle(
    ([file, content]) => {
      const transfer = new DataTransfer();
      transfer.items.add(new File([content], file));
      return transfer;
    },
    [name, text] as const,
  );
  // As long as the pointer is over the page, a file manager says so again and again.
  await expect(async () => {
    await page.dispatchEvent("main", "dragover", { dataTransfer: data });
    await expect(page.locator(".drop-sign")).toBeVisible({ timeout: 500 });
  }).toPass();
  await page.dispatchEvent("main", "drop", { dataTransfer: data });
}

test("a dropped mesh is refused in millimetres, made in metres, and flies with the next click", async ({ page, expected }) => {
  expected.pattern = /422/;
  await page.goto(process.env.PAGE_MESH_ADDRESS!);
  await drop(page, "my satellite.stl", SATELLITE);
  const dialog = page.getByRole("dialog");
  await expect(dialog.getByLabel("Name")).toHaveValue("my_satellite");
  await dialog.getByRole("button", { name: "Make the mission" }).click();
  await expect(dialog.getByRole("alert")).toContainText("my_satellite.stl: is 2900 m long after target.scale, expected 0.001 to 1000 m");
  await screenshot(page, "mesh-refused-light");
  expect(existsSync(join(FOLDER(), "my_satellite"))).toBe(false);
  await dialog.getByLabel("Scale").fill("0.001");
  await expect(dialog.getByLabel("command of the new mission")).toHaveValue(
    "mdat mission new --model 'my satellite.stl' --scale 0.001 --out my_satellite.toml",
  );
  await dialog.getByRole("button", { name: "Make the mission" }).click();
  await expect(page.getByRole("heading", { level: 1 })).toHaveText("my_satellite/my_satellite.toml");
  await expect(page.getByRole("region", { name: "The new mission" })).toContainText("size: ");
  await expect(page.locator(".problems")).toHaveCount(0);
  await screenshot(page, "mesh-made-light");

  // The command that is shown makes the same mission.
  const other = join(FOLDER(), "..", "mesh_by_command");
  mkdirSync(other, { recursive: true });
  writeFileSync(join(other, "my_satellite.stl"), SATELLITE);
  const options = ["mission", "new", "--model", "my_satellite.stl", "--scale", "0.001", "--force", "--out", "my_satellite.toml"];
  execFileSync(MDAT, options, { cwd: other });
  const text = await page.getByRole("textbox", { name: "The mission's text" }).inputValue();
  expect(text).toBe(readFileSync(join(other, "my_satellite.toml"), "utf8"));

  await page.getByRole("link", { name: "Fly …" }).click();
  await page.getByRole("button", { name: "Fly live" }).click();
  await expect(page.locator(".scene-canvas[data-frame]")).toBeAttached();
  await screenshot(page, "mesh-flies-light");
  await page.getByRole("button", { name: "Stop" }).click();
  await expect(page.getByText("The run is over.")).toBeVisible();
});

test("by keys: the file's button, the fields, Enter; a name that is taken is left as it is", async ({ page, expected }) => {
  expected.pattern = /409/;
  const file = join(FOLDER(), "..", "by_keys.stl");
  writeFileSync(file, SATELLITE);
  await page.emulateMedia({ colorScheme: "dark" });
  await page.goto(process.env.PAGE_MESH_ADDRESS!);
  await page.getByRole("button", { name: "New for a mesh …" }).focus();
  await page.keyboard.press("Enter");
  const dialog = page.getByRole("dialog");
  await dialog.locator("input[type=file]").setInputFiles(file);
  await expect(dialog.getByLabel("Name")).toHaveValue("by_keys");
  await dialog.getByLabel("Name").fill("my_satellite");
  await page.keyboard.press("Tab");
  await page.keyboard.press("Control+a");
  await page.keyboard.type("0.001");
  await page.keyboard.press("Enter");
  await expect(dialog.getByRole("alert")).toContainText("my_satellite is there already");
  expect(await seriousFindings(page)).toEqual([]);
  await screenshot(page, "mesh-taken-dark");
  await dialog.getByLabel("Name").fill("by_keys");
  await page.keyboard.press("Enter");
  await expect(page.getByRole("heading", { level: 1 })).toHaveText("by_keys/by_keys.toml");
  expect(await seriousFindings(page)).toEqual([]);
  await screenshot(page, "mesh-made-dark");
});
