// Everybody reaches everything: rules of axe, narrow pages, the keyboard.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { after, test } from "node:test";

import { QUICK, close, fixture, open, openCase } from "./browser.js";

after(close);

// The policy of the page would refuse this script.
const AXE = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");

async function violations(page) {
  await page.evaluate(AXE);
  const { violations } = await page.evaluate(() => window.axe.run(document, { resultTypes: ["violations"] }));
  return violations.map(({ id, nodes }) => `${id}: ${nodes.map((node) => `${node.html.slice(0, 160)} ${node.any[0]?.message ?? ""}`).join("\n    ")}`);
}

const TABS = ["Scene", "Results", "Drawings", "Motion", "Uncertainty", "Sensitivity", "Compare", "Estimate", "Recorder", "Avoidability", "Inputs"];

for (const [name, options] of [
  ["light", { colorScheme: "light" }],
  ["dark", { colorScheme: "dark" }],
  ["375 px", { viewport: { width: 375, height: 700 } }],
  ["320 px", { viewport: { width: 320, height: 640 } }],
]) {
  test(`axe finds nothing: ${name}`, async () => {
    const { page, heard, context } = await open({ ...options, bypassCSP: true });
    try {
      const isNarrow = options.viewport !== undefined;
      for (const tab of QUICK ? TABS.slice(0, 2) : TABS) {
        await page.getByRole("tab", { name: tab, exact: true }).click();
        assert.deepEqual(await violations(page), [], tab);
        const wide = await page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
        assert.equal(wide, 0, `${tab} is wider than the page`);
      }
      await page.getByRole("tab", { name: "Scene", exact: true }).click();
      await page.getByRole("button", { name: /^Zoom in/ }).click();
      await page.getByRole("button", { name: /^Tape/ }).press("Enter");
      assert.deepEqual(await violations(page), [], "zoom and tape");
      if (isNarrow) await page.getByRole("button", { name: "Case", exact: true }).click();
      await page.locator(".field .ask").first().click();
      assert.deepEqual(await violations(page), [], "form");
      await page.getByRole("tab", { name: "Text", exact: true }).click();
      assert.deepEqual(await violations(page), [], "text");
      await openCase(page, "wrong.toml", fixture("sae-980025.toml").replace('"67 deg"', "67"));
      await page.locator(".state .error").waitFor();
      assert.deepEqual(await violations(page), [], "error");
      await page.getByRole("button", { name: "New case…" }).click();
      assert.deepEqual(await violations(page), [], "templates");
      assert.deepEqual(heard, []);
    } finally {
      await context.close();
    }
  });
}

test("the keyboard alone: tabs, menu, warnings, a field", async () => {
  const { page, heard, context } = await open();
  try {
    await page.getByRole("tab", { name: "Scene", exact: true }).focus();
    await page.keyboard.press("ArrowRight");
    assert.equal(await page.getByRole("tab", { name: "Results" }).getAttribute("aria-selected"), "true");
    await page.keyboard.press("End");
    assert.equal(await page.getByRole("tab", { name: "Inputs" }).getAttribute("aria-selected"), "true");
    await page.locator(".menu > summary").focus();
    await page.keyboard.press("Enter");
    await page.getByRole("button", { name: "Print the report" }).waitFor();
    await page.keyboard.press("Escape");
    assert.equal(await page.locator(".menu").evaluate((menu) => menu.open), false);
    await openCase(page, "warned.toml", fixture("ricsac/03.toml"));
    await page.locator(".warned > summary").focus();
    await page.keyboard.press("Enter");
    const lead = page.locator(".warnings .leads button").first();
    await lead.focus();
    await page.keyboard.press("Enter");
    assert.ok(await page.evaluate(() => document.querySelector(".form").contains(document.activeElement)));
    assert.deepEqual(heard, []);
  } finally {
    await context.close();
  }
});

test("a screen reader hears the answer", async () => {
  const { page, context } = await open();
  try {
    const said = page.locator('[aria-live="polite"].unseen');
    await page.waitForFunction(() => document.querySelector('[aria-live="polite"].unseen').textContent !== "");
    assert.match(await said.textContent(), /Speed of vehicle 1: 51\.16 mph/);
  } finally {
    await context.close();
  }
});
