// The answer at the top: what it is the answer of, and how well it is known.
import assert from "node:assert/strict";
import { after } from "node:test";

import { caseText, close, firstResult, fixture, fromMenu, onPage, openCase, program } from "./browser.js";

after(close);

const above = async (page) => (await page.locator(".headline").innerText()).replaceAll(/\s+/g, " ");
const question = (page, value) => page.locator("#question").selectOption(value);
const tab = (page, name) => page.getByRole("tab", { name, exact: true }).click();

/** The case is weighed to its end, with its drawings. */
const weighed = async (page) => {
  await page.waitForFunction(() => !document.querySelector(".weighing") && document.querySelector(".result.first"), null, { timeout: 120_000 });
};

/** Counts the workers that the page starts: each run has one. */
const counted = (page) => page.evaluate(() => {
  window.runs = 0;
  const Plain = window.Worker;
  window.Worker = class extends Plain {
    constructor(...given) {
      super(...given);
      window.runs += 1;
    }
  };
});
const runs = (page) => page.evaluate(() => window.runs);

onPage("on a narrow page no interval is hidden", async (page) => {
  await openCase(page, "uncertain.toml", fixture("sae-980025-uncertain.toml"));
  await page.locator(".result.interval").first().waitFor();
  for (const more of await page.locator(".result-more").all()) {
    assert.equal(await more.isVisible(), true);
    assert.match(await more.innerText(), /95 %/);
  }
  await openCase(page, "skid.toml", fixture("avoid/skid.toml"));
  await page.locator(".headline", { hasText: "that the vehicle was faster than" }).waitFor();
  for (const more of await page.locator(".result-more").all()) if ((await more.textContent()) !== "") assert.equal(await more.isVisible(), true);
}, { viewport: { width: 390, height: 844 } });

onPage("warnings of an exact solution that is not the answer stand under what speaks against it", async (page) => {
  await openCase(page, "edcrash.toml", fixture("edcrash-tutorial.toml"));
  const summary = page.locator(".warned > summary");
  assert.equal(await summary.innerText(), "3 warnings, and 1 on the exact solution");
  await summary.click();
  const list = await page.locator(".warned-list").innerText();
  const [own, aside] = list.split("Objections to the exact solution");
  assert.match(own, /contact-apart.*contact-placed.*contact-placed/s);
  assert.match(aside, /momentum-differs/);
  assert.doesNotMatch(own, /momentum-differs/);
  await page.keyboard.press("Escape");
  await openCase(page, "rear-end.toml", fixture("rear-end.toml"));
  assert.equal(await summary.innerText(), "1 warning on the exact solution");
  // Of an exact solution that is the answer, all warnings are those of the answer.
  await openCase(page, "warned.toml", fixture("ricsac/03.toml"));
  assert.equal(await summary.innerText(), "3 warnings");
});

onPage("views of an exact solution that is not the answer say so, and the sensitivity names its output", async (page) => {
  const name = "rear-end-rest.toml";
  await openCase(page, name, fixture(name));
  for (const view of ["Motion", "Sensitivity"]) {
    await tab(page, view);
    await page.locator(".panel:visible .caveat", { hasText: /^Exact solution by momentum and damage, not the answer: .+\.$/ }).waitFor();
  }
  const output = /^Speed of vehicle \d, \S+ \S+ \(.*?\)/m.exec(program(name, fixture(name), "sensitivity").toString())[0];
  assert.ok((await page.locator(".influence caption").innerText()).startsWith(`${output}: change in per cent`), output);
  await openCase(page, "sae-980025.toml", fixture("sae-980025.toml"));
  await page.locator(".panel:visible .caveat").waitFor({ state: "detached" });
});

onPage("the question whether it was avoidable has the answer of its view", async (page) => {
  const name = "recorder.toml";
  await openCase(page, name, fixture("avoid/evidence.toml"));
  await question(page, "crush");
  await tab(page, "Avoidability");
  await page.locator(".avoid .run-controls", { hasText: /The speed at the impact is being found: [\d,]+ of [\d,]+/ }).waitFor();
  await page.locator(".avoid .document").waitFor({ timeout: 120_000 });
  await question(page, "avoid");
  await page.locator(".headline", { hasText: "Probability that it is avoided" }).waitFor();
  const answer = await above(page);
  await question(page, "crush");
  await question(page, "avoid");
  assert.equal(await above(page), answer);
});

onPage("an interval is that of the case, whatever was saved or renamed since", async (page) => {
  await openCase(page, "uncertain.toml", fixture("sae-980025-uncertain.toml"));
  await page.locator(".result.interval").first().waitFor();
  assert.match(await above(page), /by the ranges of the case alone.*These intervals do not contain the errors of the method/);
  const narrow = await firstResult(page);
  await fromMenu(page, "Save the report (HTML)");
  const wide = await firstResult(page);
  assert.match(await above(page), /with the errors of the method/);
  assert.doesNotMatch(await above(page), /do not contain/);
  // A title, a comment and another question change no number.
  await page.locator('[data-key="title"] input').first().fill("Another title");
  await page.waitForTimeout(1500);
  assert.equal(await firstResult(page), wide);
  for (const view of ["Results", "Scene"]) await tab(page, view);
  assert.equal(await firstResult(page), wide);
  await page.locator('[data-key="vehicle1.weight"] input').first().fill("3700");
  await page.locator(".headline", { hasText: "These intervals do not contain the errors of the method" }).waitFor();
  await page.getByRole("button", { name: "Undo" }).click();
  await page.waitForFunction((wide) => document.querySelector(".result.first .result-value").innerText === wide, wide);
  assert.notEqual(narrow, wide);
});

onPage("figures without an interval say so", async (page) => {
  await page.locator(".headline", { hasText: "The inputs and the method are taken as exact, so these figures have no interval." }).waitFor();
  await openCase(page, "uncertain.toml", fixture("sae-980025-uncertain.toml"));
  await page.locator(".result.interval").first().waitFor();
  assert.doesNotMatch(await above(page), /taken as exact/);
});

onPage("an answer of all evidence stays where a change cannot change it, and serves the estimate", async (page) => {
  await counted(page);
  const name = "rear-end-rest.toml";
  const text = fixture(name);
  await openCase(page, name, text);
  assert.equal(await page.locator("#question option:checked").innerText(), "How fast were they?");
  // Until it is there, the exact solution stands there, as what it is.
  assert.match(await above(page), /Exact solution by momentum and damage, not the answer: speed of vehicle 1 58\.1 km\/h/);
  await weighed(page);
  await tab(page, "Drawings");
  await page.locator("h2 ~ .drawing").first().waitFor({ timeout: 120_000 });
  await tab(page, "Scene");
  const answer = await above(page);
  assert.equal(await runs(page), 1);
  await page.locator('[data-key="title"] input').first().fill("Another title");
  await page.waitForTimeout(800);
  assert.equal(await above(page), answer);
  await tab(page, "Results");
  assert.match(await page.locator(".panel:visible h1").innerText(), /Another title/);
  assert.match(await page.locator(".panel:visible .answer").first().innerText(), /95 %/);
  await tab(page, "Scene");
  await question(page, "estimate");
  await page.waitForTimeout(800);
  assert.equal(await above(page), answer);
  await question(page, "reconstruct");
  assert.equal(await above(page), answer);
  assert.equal(await runs(page), 1);
  // A file is that of the case as it is now.
  await tab(page, "Scene");
  const report = await fromMenu(page, "Save the report (HTML)");
  assert.equal(report.bytes.toString(), program(name, await caseText(page), "reconstruct", "--format", "html").toString());
  assert.equal(await runs(page), 2);
  // In other units the figures stay until they are there in these.
  await page.locator("#units").selectOption("us");
  assert.doesNotMatch(await above(page), /being weighed/);
  await page.waitForFunction(() => /mph/.test(document.querySelector(".result.first .result-value").innerText), null, { timeout: 120_000 });
  await tab(page, "Results");
  await page.locator(".panel:visible .answer", { hasText: /mph.*95 %/s }).first().waitFor();
  await tab(page, "Scene");
  // Nothing is weighed anew for that.
  assert.equal(await runs(page), 2);
  // A number changes the answer, and taking it back has it at once.
  await page.locator("#units").selectOption("");
  assert.equal(await above(page), answer);
  const mass = page.locator('[data-key="vehicle1.mass"] input').first();
  await mass.fill("1401");
  await page.locator(".weighing").waitFor();
  await page.getByRole("button", { name: "Undo" }).click();
  await page.waitForFunction(() => !document.querySelector(".weighing"));
  assert.equal(await above(page), answer);
});

onPage("the page is named after its file", async (page) => {
  assert.equal(await page.title(), "sae-980025.toml – deltav");
  await page.locator('[data-key="vehicle2.speed"] input').first().fill("12");
  await page.waitForFunction(() => document.title === "• sae-980025.toml – deltav");
  await caseText(page);
  assert.equal(await page.title(), "sae-980025.toml – deltav");
});
