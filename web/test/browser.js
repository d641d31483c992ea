// The page in a browser that is installed, opened from the disk as a user would.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { test } from "node:test";
import { fileURLToPath, pathToFileURL } from "node:url";

import { chromium } from "playwright-core";

const WEB = dirname(dirname(fileURLToPath(import.meta.url)));
export const ROOT = dirname(WEB);
export const PAGE = join(WEB, "dist", "deltav.html");
export const PROGRAM = process.env.DELTAV_PROGRAM ?? join(ROOT, "target", "debug", "deltav");
export const QUICK = process.env.DELTAV_QUICK === "1";

/**
 * Says what was measured, and holds it to a limit, which is stretched by what else the machine does. The quick tests run an engine that was
 * built quickly, which is larger and slower: they only say it.
 */
export function measured(t, what, value, limit, unit, slowness = 1) {
  const stretched = limit * slowness;
  t.diagnostic(`${what}: ${value.toFixed(0)} ${unit}, of at most ${stretched.toFixed(0)}`);
  assert.ok(QUICK || value <= stretched, `${what}: ${value} ${unit}`);
}

/** (ms) that `loop` takes where nothing else runs, on the machine on which the limits were set. */
const LOOP = 130;

/** (ms) that a fixed piece of work takes in the page now. */
export const loop = (page) => page.evaluate(() => {
  const begun = performance.now();
  let x = 1;
  for (let i = 0; i < 2e7; i += 1) x = Math.sqrt(x + i);
  return x > 0 ? performance.now() - begun : Number.NaN;
});

/** How many times longer things take than where the limits were set; at least 1. */
export const slowness = (loops) => Math.max(1, Math.min(...loops) / LOOP);

const BROWSERS = [process.env.CHROMIUM, "/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"];

let running;

export async function browser() {
  const executablePath = BROWSERS.find((path) => path && existsSync(path));
  if (!executablePath) throw new Error("no Chromium: install it, or say in CHROMIUM where it is");
  running ??= await chromium.launch({ executablePath, args: ["--no-sandbox", "--disable-gpu"] });
  return running;
}

export async function close() {
  await running?.close();
}

/**
 * Opens the page, or a copy of it, and hears what it says: nothing is to be said on the console, and nothing is to
 * be asked of a network.
 */
export async function open({ file = PAGE, ...options } = {}) {
  const context = await (await browser()).newContext({ viewport: { width: 1280, height: 800 }, acceptDownloads: true, ...options });
  const page = await context.newPage();
  const heard = [];
  page.on("console", (message) => heard.push(`${message.type()}: ${message.text()}`));
  page.on("pageerror", (error) => heard.push(`error: ${error.stack}`));
  page.on("request", (request) => {
    if (!/^(file|blob|data|about):/.test(request.url())) heard.push(`request: ${request.url()}`);
  });
  // Changes that are not saved ask before they are lost.
  page.on("dialog", (dialog) => void dialog.accept());
  await page.goto(pathToFileURL(file).href);
  await page.locator("body.ready").waitFor();
  return { page, heard, context };
}

/** A test with a page of its own, which says nothing on the console and asks nothing of a network. */
export function onPage(name, run, options = {}) {
  test(name, async (t) => {
    const { page, heard, context } = await open(options);
    try {
      await run(page, t);
      assert.deepEqual(heard, []);
    } finally {
      await context.close();
    }
  });
}

/** Drags a handle of the scene by some pixels, in steps. */
export async function drag(page, handle, by, steps = 10) {
  const box = await page.locator(`[data-handle="${handle}"]`).boundingBox();
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.down();
  for (let step = 1; step <= steps; step += 1) {
    await page.mouse.move(x + (by[0] * step) / steps, y + (by[1] * step) / steps);
    await page.evaluate(() => new Promise(requestAnimationFrame));
  }
  await page.mouse.up();
}

/** The whole text of the case, as the page saves it. */
export const caseText = async (page) =>
  (await saved(page, () => page.getByRole("button", { name: "Save", exact: true }).click())).bytes.toString();

/** Another text for the case, as if somebody had opened a file of that name. */
export async function openCase(page, name, text) {
  await page.locator('input[type="file"][accept*="toml"]').setInputFiles({ name, mimeType: "application/toml", buffer: Buffer.from(text) });
  await page.waitForFunction((name) => document.querySelector(".file-name").value === name, name);
}

export const firstResult = (page) => page.locator(".result.first .result-value").innerText();

/** What a press of a button saves. */
export async function saved(page, press) {
  const [download] = await Promise.all([page.waitForEvent("download"), press()]);
  return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()) };
}

export async function fromMenu(page, entry) {
  await page.locator(".menu > summary").click();
  return saved(page, () => page.getByRole("button", { name: entry, exact: true }).click());
}

/** What the program writes for a case; files that lie beside it may be told before the command. */
export function program(name, text, ...options) {
  const folder = mkdtempSync(join(tmpdir(), "deltav-"));
  const beside = typeof options[0] === "object" ? options.shift() : {};
  for (const [file, content] of Object.entries({ [name]: text, ...beside })) writeFileSync(join(folder, file), content);
  const [command, ...others] = options;
  return execFileSync(PROGRAM, [command, name, ...others], { cwd: folder, maxBuffer: 1 << 28 });
}

export const fixture = (name) => readFileSync(join(ROOT, "fixtures", name), "utf8");

export const median = (numbers) => [...numbers].sort((a, b) => a - b)[Math.floor(numbers.length / 2)];
