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

onPage("what a case lacks is marked at its field, and worded for the form or the text", async (page) => {
  const text = fixture("sae-980025.toml");
  const without = (key) => text.replace(new RegExp(`^${key}\\s*=.*\\n`, "m"), "");
  const top = async () => (await page.locator(".state").innerText()).replaceAll(/\s+/g, " ");
  for (const [key, name, words] of [
    ["impact.crush_plane", "crush_plane", "Fill in crush plane, for example -23 deg."],
    ["vehicle1.weight", "weight", "Fill in weight, for example 3696 lb, or mass, for example 3700 lb."],
    ["vehicle1.heading", "heading", "Fill in heading, for example 180 deg."],
  ]) {
    await openCase(page, `${name}.toml`, without(name));
    const one = page.locator(`.form .field[data-key="${key}"]`);
    await one.locator(":scope > .error:not([hidden])").waitFor();
    assert.equal(await one.locator("input").first().isVisible(), true, key);
    assert.equal(await one.locator("input").first().getAttribute("aria-invalid"), "true");
    assert.ok((await one.locator(":scope > .error").innerText()).includes(words), await one.locator(":scope > .error").innerText());
    assert.ok((await top()).includes(words), await top());
  }
  // Who turns to the text reads what is to be written there, and back again.
  await openCase(page, "crush-plane.toml", without("crush_plane"));
  await page.getByRole("tab", { name: "Text", exact: true }).click();
  assert.match(await top(), /Add a line such as crush_plane = "-23 deg"/);
  await page.getByRole("tab", { name: "Form", exact: true }).click();
  assert.match(await top(), /Fill in crush plane/);
  // A key that has no field is marked where it stands.
  await openCase(page, "misspelt.toml", text.replace("yaw_inertia", "yaw_inertai"));
  await page.locator('.form .group[data-key="vehicle1"] > .group-body > .error', { hasText: "yaw_inertai" }).waitFor();
});

onPage("a long message is read whole, with its help", async (page) => {
  await openCase(page, "yaw.toml", fixture("sae-980025.toml").replace(/^yaw_inertia.*\n/m, ""));
  const box = page.locator(".state > .error");
  await box.waitFor();
  await page.mouse.move(5, 5);
  const { shown, all } = await box.evaluate((one) => ({ shown: one.clientHeight, all: one.scrollHeight }));
  assert.ok(all > 60 && (shown >= all || shown > 150), `${shown} of ${all} px`);
  // It lies over nothing, and what is below it stays where it is when it goes.
  const tabs = await page.locator(".view .tabs").boundingBox();
  assert.ok((await box.boundingBox()).y + (await box.boundingBox()).height <= tabs.y);
  await page.locator('[data-key="vehicle1.yaw_inertia"] input').first().fill("2437");
  await box.waitFor({ state: "detached" });
  assert.equal((await page.locator(".view .tabs").boundingBox()).y, tabs.y);
});

onPage("an error says so where the scene would be, and names of files stay as they are", async (page) => {
  await openCase(page, "wrong.toml", "[vehicle1]\nmass = 3\n");
  await page.getByText("The case file has an error. Correct it, and the scene appears.").waitFor();
  await page.locator('input[type="file"][accept*="toml"]').setInputFiles({ name: "report.pdf", mimeType: "application/pdf", buffer: Buffer.from([0xff, 0xfe, 0xfd]) });
  await page.locator(".state .error", { hasText: "report.pdf is not a case file" }).waitFor();
});

onPage("a number with an exponent keeps it", async (page) => {
  const weight = page.locator('[data-key="vehicle1.weight"]').first();
  await weight.locator("input").first().fill("3.696e3");
  await weight.locator("input").first().press("Tab");
  assert.match(await caseText(page), /^weight *= "3\.696e3 lb"/m);
  await page.waitForTimeout(300);
  assert.equal(await weight.locator("input").first().inputValue(), "3.696e3");
  assert.equal(await weight.locator("select.unit").inputValue(), "lb");
  assert.equal(await page.locator(".state .error").count(), 0);
});

onPage("the diameter of a fixed object is one of its first fields", async (page) => {
  const first = page.locator('.group[data-key="vehicle2"] > .group-body > [data-key="vehicle2.diameter"]');
  assert.equal(await first.count(), 0);
  const fixed = await field(page, "vehicle2.fixed");
  await fixed.locator("select").selectOption("true");
  await first.waitFor();
  assert.equal(await page.evaluate(() => document.activeElement.closest("[data-key]").dataset.key), "vehicle2.fixed");
});

onPage("no word of a label is broken", async (page) => {
  await openCase(page, "pedestrian.toml", fixture("avoid/pedestrian.toml"));
  await field(page, "avoid.deceleration");
  for (let depth = 0; depth < 4; depth += 1) {
    await page.locator(".form details:not([open])").evaluateAll((all) => all.forEach((one) => (one.open = true)));
    await page.waitForTimeout(100);
  }
  const broken = await page.locator(".form .name label").evaluateAll((all) => all.flatMap((label) => {
    const words = label.firstChild;
    return [...words.data.matchAll(/\S+/g)].filter(({ 0: word, index }) => {
      const place = document.createRange();
      place.setStart(words, index);
      place.setEnd(words, index + word.length);
      return place.getClientRects().length > 1;
    }).map(([word]) => word);
  }));
  assert.deepEqual(broken, []);
});
