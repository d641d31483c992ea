import assert from "node:assert/strict";
import { after } from "node:test";

import { caseText, close, fixture, onPage, openCase } from "./browser.js";

after(close);

/** The field of a key, in whatever part of the form it is folded away. */
async function field(page, key) {
  const one = page.locator(`.form .field[data-key="${key}"]`);
  for (let depth = 0; depth < 4; depth += 1) {
    await page.locator(".form details:not([open])").evaluateAll((all, key) => all.filter((part) => part.classList.contains("more") || key.startsWith(part.dataset.key)).forEach((part) => (part.open = true)), key);
    await page.waitForTimeout(50);
  }
  return one;
}

const lineOf = (text, key) => new RegExp(`^${key}\\s*=.*$`, "m").exec(text)?.[0];

onPage("a number with a source has its number, unit, range and source as fields", async (page) => {
  const text = fixture("avoid/pedestrian.toml").replace(/^limit .*$/m, 'limit = { value = "30 km/h", source = "sign" }').replace(/^reaction_time .*$/m, 'reaction_time = { low = "0.5 s", high = "1.2 s", source = "Dettinger" }');
  await openCase(page, "pedestrian.toml", text);
  const limit = await field(page, "avoid.limit");
  const number = limit.locator("input.number").first();
  assert.equal(await number.inputValue(), "30");
  assert.equal(await limit.locator("select.unit").inputValue(), "km/h");
  assert.equal(await limit.getByLabel("source").inputValue(), "sign");
  // What is typed letter by letter stands in the case letter for letter, with its source.
  await number.press("Control+a");
  await page.keyboard.type("50 km/h", { delay: 150 });
  assert.equal(await number.inputValue(), "50 km/h");
  assert.equal(lineOf(await caseText(page), "limit"), 'limit = { value = "50 km/h", source = "sign" }');
  await limit.getByLabel("source").fill("built-up area");
  assert.equal(lineOf(await caseText(page), "limit"), 'limit = { value = "50 km/h", source = "built-up area" }');
  await limit.getByLabel("source").fill("");
  assert.equal(lineOf(await caseText(page), "limit"), 'limit = "50 km/h"');
  const reaction = await field(page, "avoid.reaction_time");
  assert.equal(await reaction.locator("select.mode").inputValue(), "uniform");
  await reaction.getByLabel("highest value").fill("1.4");
  assert.equal(lineOf(await caseText(page), "reaction_time"), 'reaction_time = { low = "0.5 s", high = "1.4 s", source = "Dettinger" }');
  assert.equal(await page.locator(".state .error").count(), 0);
});

onPage("a field that shows what the case does not have says so", async (page) => {
  // A range of which a number was taken away.
  await openCase(page, "range.toml", fixture("sae-980025.toml").replace(/^speed( *)= "10 mph"/m, 'speed$1= { low = "8 mph", high = "12 mph" }'));
  const speed = await field(page, "vehicle2.speed");
  await speed.getByLabel("highest value").fill("");
  await speed.getByLabel("highest value").press("Tab");
  await page.locator('.form [data-key="vehicle2.heading"] input').first().focus();
  await speed.locator(".error", { hasText: "not in the case yet" }).waitFor();
  await speed.getByLabel("highest value").fill("13");
  await speed.locator(".error").waitFor({ state: "hidden" });
  assert.match(lineOf(await caseText(page), "speed"), /high = "13 mph"/);
  // What only the text can show takes a number as one types it.
  await openCase(page, "mixed.toml", fixture("sae-980025.toml").replace(/^heading( *)= "67 deg"/m, 'heading$1= { degrees = 67 }'));
  const heading = await field(page, "vehicle2.heading");
  const input = heading.locator("input").first();
  assert.match(await input.inputValue(), /degrees/);
  await input.press("Control+a");
  await page.keyboard.type("67 deg", { delay: 150 });
  assert.equal(await input.inputValue(), "67 deg");
  assert.match(await caseText(page), /^heading *= "67 deg"/m);
  // What is no value of a file is refused at its field.
  await openCase(page, "wheels.toml", fixture("rear-end-rest.toml"));
  const drag = await field(page, "vehicle1.after.drag");
  await drag.locator("input").first().fill("abc def");
  await drag.locator("input").first().press("Tab");
  await drag.locator(".error span").first().waitFor();
});

onPage("an emptied field shows its number again when that is undone", async (page) => {
  const speed = page.locator('[data-key="vehicle2.speed"] input').first();
  await speed.fill("");
  await speed.press("Enter");
  await page.getByRole("button", { name: "Undo" }).click();
  await page.waitForFunction(() => document.querySelector('[data-key="vehicle2.speed"] input').value === "10");
});

onPage("an empty field offers the unit that the case uses", async (page) => {
  const unit = async (key) => (await field(page, key)).locator("select.unit").first().inputValue();
  // The paper's example is in mph, lb, in and ft.
  await page.waitForTimeout(200);
  assert.equal(await unit("vehicle1.speed"), "mph");
  assert.equal(await unit("vehicle1.crush.offset"), "in");
  assert.equal(await unit("vehicle2.crush.ees"), "mph");
  await page.getByRole("button", { name: "New case…" }).click();
  await page.locator("#template-units").selectOption("si");
  await page.locator('.card[data-name="intersection"]').click();
  await page.waitForFunction(() => document.querySelector(".file-name").value === "intersection.toml");
  await page.waitForTimeout(300);
  assert.equal(await unit("vehicle1.speed"), "km/h");
  assert.equal(await unit("vehicle1.crush.ees"), "km/h");
  assert.equal(await unit("vehicle1.crush.spacing"), "cm");
  assert.equal(await unit("vehicle1.weight"), "N");
  assert.equal(await unit("scene.contact.x"), "m");
  assert.equal(await unit("avoid.limit"), "km/h");
  // A unit that was chosen stays.
  const limit = await field(page, "avoid.limit");
  await limit.locator("select.unit").selectOption("m/s");
  await limit.locator("input").first().fill("14");
  assert.match(await caseText(page), /^limit *= "14 m\/s"/m);
});
