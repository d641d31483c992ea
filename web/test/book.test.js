// A page that lies in the folder of the book links into it, and no other page does.
import assert from "node:assert/strict";
import { existsSync, mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, test } from "node:test";

import { PAGE, ROOT, close, fixture, fromMenu, open, openCase } from "./browser.js";

after(close);

/** The page as `xtask release` puts it into the book. */
const marked = () => {
  const file = join(mkdtempSync(join(tmpdir(), "deltav-book-")), "deltav.html");
  writeFileSync(file, readFileSync(PAGE, "utf8").replace('<meta charset="utf-8">', '<meta charset="utf-8"><meta name="deltav-book">'));
  return file;
};

const links = (page) => page.locator("a.book").evaluateAll((all) => all.map((one) => one.getAttribute("href")));

/** Opens what explains a field, and the tables around it, which are filled as they open. */
async function help(page, key) {
  const parts = key.split(".");
  for (const length of parts.keys()) {
    const group = page.locator(`details.group[data-key="${parts.slice(0, length).join(".")}"]`);
    if ((await group.count()) === 0) continue;
    await group.evaluate((one) => (one.open = true));
    await group.locator(".field").first().waitFor({ state: "attached" });
  }
  const field = page.locator(`.field[data-key="${key}"]`);
  for (const more of await field.locator("xpath=ancestor::details").all()) await more.evaluate((one) => (one.open = true));
  await field.locator(".ask").first().click();
  return field;
}

test("in the folder of the book, views, questions and fields lead to the chapter that explains them", async () => {
  const { page, heard, context } = await open({ file: marked() });
  try {
    await openCase(page, "rear-end.toml", fixture("rear-end.toml"));
    const chapters = { Scene: "conventions", Results: "report", Sensitivity: "sensitivity", Estimate: "estimate", Recorder: "recorder", Avoidability: "avoid" };
    for (const [tab, chapter] of Object.entries(chapters)) {
      await page.getByRole("tab", { name: tab, exact: true }).click();
      const link = page.getByRole("link", { name: `More in the book: ${tab}`, exact: true });
      assert.equal(await link.getAttribute("href"), `docs/guide/${chapter}.html`, tab);
      assert.ok(await link.isVisible(), tab);
    }
    assert.equal(await page.locator(".question a.book").getAttribute("href"), "docs/guide/reconciliation.html");
    for (const [key, to] of [["vehicle1.crush.width", "crush.html"], ["impact.restitution", "impact.html#restitution"], ["vehicle2.mass", "case-file.html#vehicle1-or-vehicle2"]]) {
      const field = await help(page, key);
      assert.equal(await field.locator("a.book").getAttribute("href"), `docs/guide/${to}`, key);
    }
    await page.getByRole("button", { name: "New case…" }).click();
    assert.equal(await page.locator("dialog a.book").getAttribute("href"), "docs/guide/choose.html");
    // Each leads to a page that the book is made of; that its places are there, the check of the book's links holds.
    for (const to of await links(page)) assert.ok(existsSync(join(ROOT, to.replace(/\.html(#.*)?$/, ".md"))), to);
    assert.deepEqual(heard, []);
  } finally {
    await context.close();
  }
});

test("elsewhere, there is no link into the book, nor in a report that was saved beside it", async () => {
  const book = await open({ file: marked() });
  const { bytes } = await fromMenu(book.page, "Save an interactive report");
  await book.context.close();
  // But for what it was handed over with, it is the page.
  const slot = /(<script type="application\/json" id="deltav-live">)[^<]*/;
  assert.equal(bytes.toString().replace(slot, "$1null"), readFileSync(PAGE, "utf8"));
  const { page, context } = await open();
  try {
    const field = await help(page, "vehicle1.mass");
    assert.ok(await field.locator(".help").isVisible());
    assert.deepEqual(await links(page), []);
  } finally {
    await context.close();
  }
});
