// The draft that the tab keeps, so that a reload does not lose the case.
import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after } from "node:test";
import { pathToFileURL } from "node:url";

import { caseText, close, fixture, fromMenu, onPage, openCase } from "./browser.js";

after(close);

const KEY = "deltav-draft";
const line = (page) => page.locator(".welcome");
const name = (page) => page.locator(".file-name").inputValue();
const isUnsaved = (page) => page.locator(".unsaved").isVisible();

/** Loads the page again, or another one in the same browser. */
const load = async (page, url = page.url()) => {
  await page.goto(url);
  await page.locator("body.ready").waitFor();
};

/** The text is kept. */
const kept = (page, words) => page.waitForFunction(([key, words]) => sessionStorage.getItem(key)?.includes(words), [KEY, words]);
const forgotten = (page) => page.waitForFunction((key) => sessionStorage.getItem(key) === null, KEY);

const setSpeed = (page, speed) => page.locator('[data-key="vehicle2.speed"] input').first().fill(speed);

onPage("a reload has the case as it was left, and starts afresh if that is wanted", async (page) => {
  assert.match(await line(page).innerText(), /This is an example/);
  await load(page);
  assert.match(await line(page).innerText(), /This is an example/);
  const text = fixture("rear-end.toml");
  await openCase(page, "rear-end.toml", text);
  await page.locator("#units").selectOption("si");
  await setSpeed(page, "12");
  await kept(page, "12 mph");
  await load(page);
  assert.match(await line(page).innerText(), /^This is your draft of \d+ \w+ \d{4} at \d\d:\d\d, which this tab has kept\./);
  assert.equal(await name(page), "rear-end.toml");
  assert.equal(await page.locator("#units").inputValue(), "si");
  // It is a change of the file that was opened, and the answer is in the units that were chosen.
  assert.equal(await isUnsaved(page), true);
  await page.locator(".headline", { hasText: "km/h" }).waitFor();
  await line(page).getByRole("button", { name: "Got it" }).click();
  assert.equal(await line(page).count(), 0);
  const draft = await caseText(page);
  assert.equal(draft, text.replace('speed       = "0 mph"', 'speed       = "12 mph"'));
  // What is saved is no change of its file.
  await load(page);
  assert.equal(await isUnsaved(page), false);
  await line(page).getByRole("button", { name: "Start afresh" }).click();
  assert.equal(await name(page), "sae-980025.toml");
  assert.equal(await line(page).count(), 0);
  await forgotten(page);
  await load(page);
  assert.match(await line(page).innerText(), /This is an example/);
});

onPage("the next case takes the place of the draft, which is as old as its last change", async (page) => {
  await setSpeed(page, "11");
  await kept(page, "11 ");
  const time = () => page.evaluate((key) => JSON.parse(sessionStorage.getItem(key)).time, KEY);
  const before = await time();
  await load(page);
  await page.waitForTimeout(500);
  assert.equal(await time(), before);
  await openCase(page, "barrier.toml", fixture("barrier.toml"));
  assert.equal(await line(page).count(), 0);
  await kept(page, "barrier.toml");
  await load(page);
  assert.equal(await caseText(page), fixture("barrier.toml"));
  await page.getByRole("button", { name: "New case…" }).click();
  await page.locator('.card[data-name="avoid"]').click();
  await kept(page, "avoid.toml");
  await load(page);
  assert.equal(await name(page), "avoid.toml");
});

onPage("an interactive report shows its own case, and keeps no draft", async (page) => {
  const report = await fromMenu(page, "Save an interactive report");
  await setSpeed(page, "11");
  await kept(page, "11 ");
  const draft = await page.evaluate((key) => sessionStorage.getItem(key), KEY);
  const file = join(tmpdir(), `deltav-draft-${process.pid}.html`);
  writeFileSync(file, report.bytes);
  await load(page, pathToFileURL(file).href);
  assert.doesNotMatch(await line(page).innerText(), /draft/);
  await setSpeed(page, "13");
  await page.locator(".welcome", { hasText: "has been changed since" }).waitFor();
  await page.waitForTimeout(500);
  assert.equal(await page.evaluate((key) => sessionStorage.getItem(key), KEY), draft);
});

onPage("where the browser keeps nothing, or something else stands there, the page begins with the example", async (page) => {
  await page.evaluate((key) => sessionStorage.setItem(key, '{"text": 5}'), KEY);
  await load(page);
  assert.match(await line(page).innerText(), /This is an example/);
  await page.evaluate((key) => sessionStorage.setItem(key, "{"), KEY);
  await load(page);
  assert.match(await line(page).innerText(), /This is an example/);
  await page.addInitScript(() => Object.defineProperty(window, "sessionStorage", {
    get: () => {
      throw new DOMException("The operation is insecure.", "SecurityError");
    },
  }));
  await load(page);
  await setSpeed(page, "11");
  await page.waitForFunction(() => document.title.startsWith("•"));
  await page.waitForTimeout(500);
  await load(page);
  assert.match(await line(page).innerText(), /This is an example/);
});
