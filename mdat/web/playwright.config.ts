// Tests of the page in Debian's Chromium, drawing in software, against a real mdat serve (test/page/server.ts). What they leave is in PAGE_OUT.
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { defineConfig } from "@playwright/test";

export const OUT = process.env.PAGE_OUT ?? join(fileURLToPath(new URL(".", import.meta.url)), "../../out/page");

export default defineConfig({
  testDir: "test/page",
  outputDir: join(OUT, "traces"),
  globalSetup: "./test/page/server.ts",
  workers: 2,
  fullyParallel: true,
  forbidOnly: true,
  retries: 0,
  // What is waited for comes within a second; a machine that compiles beside takes its time.
  timeout: 180_000,
  expect: { timeout: 45_000 },
  reporter: [["list"], ["junit", { outputFile: join(OUT, "junit.xml") }]],
  use: {
    browserName: "chromium",
    viewport: { width: 1280, height: 720 },
    colorScheme: "light",
    contextOptions: { reducedMotion: "no-preference" },
    permissions: ["clipboard-read", "clipboard-write"],
    launchOptions: {
      executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
      args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
    },
  },
});
