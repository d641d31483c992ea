// The scene seen larger, and the tape over it.
import assert from "node:assert/strict";
import { after } from "node:test";

import { caseText, close, drag, fixture, onPage, openCase } from "./browser.js";

after(close);

const SIZES = [["1280 × 800", {}], ["375 × 700", { viewport: { width: 375, height: 700 } }]];

const press = (page, name) => page.getByRole("button", { name }).click();

/** (px) the middle of a part of the drawing. */
async function middle(page, part) {
  const { x, y, width, height } = await page.locator(part).boundingBox();
  return [x + width / 2, y + height / 2];
}

const away = ([x, y], [toX, toY]) => Math.hypot(toX - x, toY - y);
const assertNear = (one, other, within = 1.5) => assert.ok(away(one, other) <= within, `${one} and ${other}`);

/** (px) between both centres of gravity. */
const apart = async (page) => away(await middle(page, "#scene-cg-1"), await middle(page, "#scene-cg-2"));

const seen = (page) => page.locator(".stage .sheet svg").getAttribute("viewBox");

/** A wheel over a place of the page. */
async function wheel(page, [x, y], delta) {
  await page.mouse.move(x, y);
  await page.mouse.wheel(0, delta);
  await page.waitForTimeout(60);
}

onPage("a wheel zooms about the pointer, as far as all of it, and the case stays as it is", async (page) => {
  const text = await caseText(page);
  const whole = await seen(page);
  const wide = await apart(page);
  const contact = await middle(page, "#scene-contact");
  // A browser tells whole pixels.
  const pointer = contact.map(Math.floor);
  await wheel(page, pointer, -500);
  const factor = Number.parseFloat(await page.locator(".lens-factor").innerText());
  assertNear(await middle(page, "#scene-contact"), [0, 1].map((axis) => pointer[axis] + factor * (contact[axis] - pointer[axis])), 0.3);
  assert.ok(factor > 2 && Math.abs((await apart(page)) / wide - factor) < 0.06, `${factor}`);
  // Back about another place, which is at the edge by then.
  await wheel(page, [contact[0] + 100, contact[1] + 50], 2000);
  assert.equal(await seen(page), whole);
  assert.equal(await caseText(page), text);
  assert.equal(await page.getByRole("button", { name: "Undo" }).isEnabled(), false);
});

for (const [size, options] of SIZES) {
  onPage(`buttons and keys zoom and move what is seen, and handles lie where they are drawn: ${size}`, async (page) => {
    const whole = await seen(page);
    const wide = await apart(page);
    await press(page, "Zoom in (+)");
    assert.ok(Math.abs((await apart(page)) / wide - 1.5) < 0.02);
    await page.locator(".stage").focus();
    await page.keyboard.press("+");
    assert.ok(Math.abs((await apart(page)) / wide - 2.25) < 0.02);
    const before = await middle(page, "#scene-contact");
    await page.keyboard.press("ArrowLeft");
    await page.keyboard.press("ArrowUp");
    const moved = await middle(page, "#scene-contact");
    assert.ok(moved[0] > before[0] + 10 && moved[1] > before[1] + 10, `${before} ${moved}`);
    // The two handles of the contact point lie beside it.
    for (const vehicle of [1, 2]) {
      const [x, y] = await middle(page, `[data-handle="contact-${vehicle}-0"]`);
      assertNear([x, y], [moved[0] + (vehicle === 1 ? -8 : 8), moved[1]], 2);
    }
    await page.keyboard.press("-");
    await page.keyboard.press("-");
    assert.equal(await seen(page), whole);
    await page.keyboard.press("+");
    await page.keyboard.press("0");
    assert.equal(await seen(page), whole);
    await press(page, "Zoom in (+)");
    await press(page, "Fit: show all of the scene (0)");
    assert.equal(await seen(page), whole);
    for (const button of await page.locator(".lens-tools button").all()) {
      const { width, height } = await button.boundingBox();
      assert.ok(width >= 24 && height >= 24, `${width} × ${height}`);
    }
  }, options);
}

onPage("a part that is seen larger has a scale of its own, in the units of the answer", async (page) => {
  const bar = page.locator(".scale-bar");
  assert.equal(await bar.isVisible(), false);
  const { feet } = betweenCentres();
  for (const [system, unit, each] of [["us", "ft", 1], ["si", "m", 1 / 0.3048]]) {
    await page.locator("#units").selectOption(system);
    for (let time = 0; time < 3; time += 1) {
      await press(page, "Zoom in (+)");
      const [, length] = new RegExp(`^(\\S+) ${unit}$`).exec(await bar.innerText());
      const perFoot = (await apart(page)) / feet;
      const { width } = await bar.boundingBox();
      assert.ok(Math.abs(width - Number(length) * each * perFoot) < 1, `${length} ${unit}: ${width} px`);
    }
    await page.locator(".stage").press("0");
  }
});

onPage("the empty ground is dragged, and what is seen of it follows the pointer", async (page) => {
  const text = await caseText(page);
  const box = await page.locator(".stage").boundingBox();
  await wheel(page, await middle(page, "#scene-contact"), -400);
  const before = await middle(page, "#scene-contact");
  // Above vehicle 1 there is nothing.
  const ground = [box.x + box.width - 60, box.y + 60];
  await page.mouse.move(...ground);
  await page.mouse.down();
  await page.mouse.move(ground[0] - 30, ground[1] + 25, { steps: 3 });
  await page.mouse.up();
  assertNear(await middle(page, "#scene-contact"), [before[0] - 30, before[1] + 25]);
  // The middle button moves it over a vehicle, too.
  await page.mouse.move(...(await middle(page, "#scene-cg-1")));
  await page.mouse.down({ button: "middle" });
  const at = await middle(page, "#scene-contact");
  await page.mouse.move(...(await middle(page, "#scene-cg-1")).map((place) => place - 20), { steps: 3 });
  await page.mouse.up({ button: "middle" });
  assertNear(await middle(page, "#scene-contact"), at.map((place) => place - 20));
  assert.equal(await caseText(page), text);
});

const heading2 = async (page) => Number(/^\[vehicle2\][^[]*^heading\s*=\s*"(\S+) deg"/m.exec(await caseText(page))[1]);

onPage("a vehicle that is seen larger is dragged as before, and the scene holds still during and after it", async (page) => {
  const text = await caseText(page);
  // Twice as many pixels of a scene that is twice as large are the same metres.
  const handle = '[data-handle="heading-2-0"]';
  await drag(page, "heading-2-0", [-30, 10]);
  const expected = await heading2(page);
  assert.ok(Math.abs(expected - 67) > 3);
  await page.locator("body").press("Control+z");
  await wheel(page, await middle(page, handle), -Math.log(2) / 0.002);
  const contact = await middle(page, "#scene-contact");
  const [x, y] = await middle(page, handle);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x - 60, y + 20, { steps: 5 });
  await page.waitForFunction(() => document.querySelector(".result.first .result-value").innerText !== "51.16 mph");
  assertNear(await middle(page, "#scene-contact"), contact, 0.01);
  // A wheel meanwhile moves nothing.
  await page.mouse.wheel(0, -300);
  await page.waitForTimeout(60);
  assertNear(await middle(page, "#scene-contact"), contact, 0.01);
  await page.mouse.up();
  assertNear(await middle(page, "#scene-contact"), contact, 0.01);
  assert.ok(Math.abs((await heading2(page)) - expected) < 0.3, `${await heading2(page)} for ${expected}`);
  await page.locator("body").press("Control+z");
  assert.equal(await caseText(page), text);
});

onPage("a handle that is not seen comes into sight with the focus", async (page) => {
  await wheel(page, await middle(page, "#scene-cg-1"), -1000);
  const box = await page.locator(".stage").boundingBox();
  const handle = '[data-handle="heading-2-0"]';
  const isSeen = async () => {
    const [x, y] = await middle(page, handle);
    return x > box.x && x < box.x + box.width && y > box.y && y < box.y + box.height;
  };
  assert.equal(await isSeen(), false);
  await page.locator(handle).evaluate((knob) => knob.focus());
  assert.equal(await isSeen(), true);
  assert.equal(await page.locator(".stage").evaluate((stage) => stage.scrollLeft + stage.scrollTop), 0);
});

onPage("what was drawn in a part is drawn anew when all of it is seen, and another view or case is seen whole", async (page) => {
  const drawn = () => page.locator(".stage .sheet").innerHTML();
  await openCase(page, "rear-end-rest.toml", fixture("rear-end-rest.toml"));
  await press(page, "Zoom in (+)");
  await press(page, /^Tape/);
  await page.getByLabel("What is drawn").selectOption("motion");
  assert.equal(await page.locator(".zoomed, .measuring").count(), 0);
  const motion = await drawn();
  await press(page, "Zoom in (+)");
  assert.notEqual(await drawn(), motion);
  // Farther away than what was drawn.
  await page.getByRole("tab", { name: "Text", exact: true }).click();
  const far = (await caseText(page)).replace(/rest( *)= \{ x = "[^"]*"/, 'rest$1= { x = "60 m"');
  assert.notEqual(far, await caseText(page));
  await page.locator(".cm-content").press("Control+a");
  const before = await drawn();
  await page.evaluate((text) => document.execCommand("insertText", false, text), far);
  await page.waitForFunction((before) => document.querySelector(".stage .sheet").innerHTML !== before, before);
  await press(page, "Fit: show all of the scene (0)");
  const fitted = await drawn();
  await page.reload();
  await page.locator("body.ready").waitFor();
  await openCase(page, "rear-end-rest.toml", far);
  await page.getByLabel("What is drawn").selectOption("motion");
  assert.equal(fitted, await drawn());
  assert.notEqual(fitted, motion);
  await press(page, "Zoom in (+)");
  await openCase(page, "other.toml", fixture("sae-980025.toml"));
  assert.equal(await page.locator(".zoomed").count(), 0);
});

onPage("two fingers zoom, also over a vehicle, and leave the case as it is", async (page) => {
  const text = await caseText(page);
  await press(page, "Got it");
  await page.locator(".stage").scrollIntoViewIfNeeded();
  const client = await page.context().newCDPSession(page);
  const [x, y] = await middle(page, "#scene-cg-1");
  const wide = await apart(page);
  const touch = (type, ...points) => client.send("Input.dispatchTouchEvent", { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
  const vertical = (by) => [[x, y - by], [x, y + by]];
  await touch("touchStart", vertical(15)[0]);
  await touch("touchStart", ...vertical(15));
  for (const by of [20, 30, 40, 45]) await touch("touchMove", ...vertical(by));
  await touch("touchEnd");
  await page.waitForTimeout(60);
  assert.ok(Math.abs((await apart(page)) / wide - 3) < 0.1, `${(await apart(page)) / wide}`);
  assertNear(await middle(page, "#scene-cg-1"), [x, y], 3);
  assert.equal(await caseText(page), text);
  // One finger moves what is seen, on empty ground.
  const box = await page.locator(".stage").boundingBox();
  const ground = [box.x + box.width - 60, box.y + box.height - 30];
  await touch("touchStart", ground);
  for (const by of [5, 10, 20]) await touch("touchMove", [ground[0] - by, ground[1] - by]);
  await touch("touchEnd");
  await page.waitForTimeout(60);
  assertNear(await middle(page, "#scene-cg-1"), [x - 20, y - 20], 3);
  assert.equal(await caseText(page), text);
}, { hasTouch: true, viewport: { width: 375, height: 700 } });

/** Polar and back, in the file's degrees: where the contact point lies from a CG. */
const polar = (length, degrees) => [length * Math.cos((degrees * Math.PI) / 180), length * Math.sin((degrees * Math.PI) / 180)];

/** From CG 1 to CG 2 of SAE 980025, by way of the contact point, from what the paper prints. */
function betweenCentres() {
  const [toContact, fromContact] = [polar(6.3, 180 - 22.4), polar(3.8, 67 - 39)];
  const [x, y] = [toContact[0] - fromContact[0], toContact[1] - fromContact[1]];
  return { feet: Math.hypot(x, y), degrees: (Math.atan2(y, x) * 180) / Math.PI };
}

/** Draws the tape by mouse. */
async function measure(page, from, to) {
  await page.mouse.move(...from);
  await page.mouse.down();
  await page.mouse.move(...to, { steps: 4 });
  await page.mouse.up();
}

const reading = (page) => page.locator(".tape-reading").innerText();

onPage("the tape has length and direction of the file, and is no part of it", async (page) => {
  const text = await caseText(page);
  const { feet, degrees } = betweenCentres();
  await press(page, /^Tape/);
  await measure(page, await middle(page, "#scene-cg-1"), await middle(page, "#scene-cg-2"));
  assert.equal(await reading(page), `${feet.toFixed(2)} ft at ${degrees.toFixed(1)}°`);
  await page.locator("#units").selectOption("si");
  assert.equal(await reading(page), `${(feet * 0.3048).toFixed(2)} m at ${degrees.toFixed(1)}°`);
  await page.locator("#units").selectOption("us");
  // An end is taken from CG 2 to beside the contact point: it holds to it, at 6.3 ft of CG 1, as the file has it.
  const [from, to] = [await middle(page, "#scene-cg-2"), await middle(page, "#scene-contact")];
  await measure(page, [from[0] + 4, from[1] - 3], [to[0] - 5, to[1] + 6]);
  assert.equal(await reading(page), "6.30 ft at 157.6°");
  // Two places that are no marks, on a scene that is seen larger, too: as many feet as they are pixels apart.
  const perFoot = (await apart(page)) / feet;
  const box = await page.locator(".stage").boundingBox();
  const corner = [box.x + box.width - 50, box.y + 150];
  await measure(page, corner, [corner[0], corner[1] - 60]);
  assert.equal(await reading(page), `${(60 / perFoot).toFixed(2)} ft at 90.0°`);
  await wheel(page, corner, -400);
  const larger = (await apart(page)) / feet;
  assert.ok(larger > 1.5 * perFoot);
  await measure(page, [corner[0], corner[1] + 40], [corner[0] - 60, corner[1] + 40]);
  const [length, angle] = /^(\S+) ft at (\S+)°$/.exec(await reading(page)).slice(1);
  assert.ok(Math.abs(Number(length) - 60 / larger) < 0.02 && angle === "180.0", await reading(page));
  // Vehicles stay where they are under it.
  assert.equal(await caseText(page), text);
  assert.equal(await page.getByRole("button", { name: "Undo" }).isEnabled(), false);
  await page.keyboard.press("Escape");
  assert.equal(await page.locator(".tape").isVisible(), false);
  assert.equal(await page.getByRole("button", { name: /^Tape/ }).getAttribute("aria-pressed"), "false");
});

onPage("a tape counts angles as the file does, and goes with the marks that it holds to", async (page) => {
  // The same crash in the axes of SAE J670: every angle has the other sign.
  const mirrored = fixture("sae-980025.toml").replace("heading     = \"180 deg\"", 'heading = "-180 deg"').replace('"67 deg"', '"-67 deg"')
    .replace('"-22.4 deg"', '"22.4 deg"').replace('"-39 deg"', '"39 deg"').replace('"-23 deg"', '"23 deg"');
  await openCase(page, "mirrored.toml", `${mirrored}\n[scene]\naxes = "z-down"\n`);
  const { feet, degrees } = betweenCentres();
  await page.getByRole("button", { name: /^Tape/ }).press("Enter");
  assert.equal(await reading(page), `${feet.toFixed(2)} ft at −${degrees.toFixed(1)}°`);
  // The CG of vehicle 1 is farther from the contact point, and the tape goes with it.
  await page.locator('[data-key="vehicle1.contact.distance"] input').first().fill("9.3");
  await page.waitForFunction((before) => document.querySelector(".tape-reading").innerText !== before, `${feet.toFixed(2)} ft at −${degrees.toFixed(1)}°`);
  const [toContact, fromContact] = [polar(9.3, 157.6), polar(3.8, 28)];
  const length = Math.hypot(toContact[0] - fromContact[0], toContact[1] - fromContact[1]);
  assert.match(await reading(page), new RegExp(`^${length.toFixed(2)} ft`));
});

for (const [size, options] of SIZES) {
  onPage(`the tape by keyboard: ${size}`, async (page) => {
    await page.getByRole("button", { name: /^Tape/ }).focus();
    await page.keyboard.press("Enter");
    const { feet } = betweenCentres();
    assert.match(await reading(page), new RegExp(`^${feet.toFixed(2)} ft`));
    const end = page.getByRole("button", { name: /^End of the tape: CG of vehicle 2/ });
    await end.focus();
    // After CG 2 comes the contact point.
    await page.keyboard.press("Enter");
    assert.equal(await reading(page), "6.30 ft at 157.6°");
    await page.getByRole("button", { name: "End of the tape: Contact point" }).waitFor();
    // Five steps of 5 cm to the left.
    await page.keyboard.press("Shift+ArrowLeft");
    const [x, y] = polar(6.3, 157.6);
    assert.match(await reading(page), new RegExp(`^${Math.hypot(x - 0.25 / 0.3048, y).toFixed(2)} ft`));
    await page.keyboard.press("Escape");
    assert.equal(await page.locator(".tape").isVisible(), false);
    assert.match(await page.evaluate(() => document.activeElement.textContent), /^Tape$/);
    const wide = await page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
    assert.equal(wide, 0);
  }, options);
}

onPage("the buttons of the scene lie over no part of it, and a handle says where an arrow key has moved it", async (page) => {
  for (const name of ["sae-980025.toml", "rear-end-rest.toml"]) {
    await openCase(page, name, fixture(name));
    const stage = await page.locator(".stage").boundingBox();
    const tools = await page.locator(".lens-tools").boundingBox();
    assert.ok(tools.y + tools.height <= stage.y, name);
    // The heading is seen whole, of three lines, too, and handles lie where they are drawn.
    assert.ok((await page.locator(".stage .sheet text").first().boundingBox()).y >= stage.y, name);
    const apart = async () => {
      const grip = await page.locator('[data-handle="contact-1-0"]').boundingBox();
      return Math.abs(grip.y + grip.height / 2 - (await middle(page, "#scene-contact"))[1]);
    };
    // The layout may still settle between the two measurements.
    for (let tries = 0; tries < 20 && await apart() >= 1; tries++) await page.waitForTimeout(100);
    assert.ok(await apart() < 1, name);
  }
  await openCase(page, "sae-980025.toml", fixture("sae-980025.toml"));
  await page.locator('[data-handle="heading-2-0"]').press("ArrowLeft");
  assert.equal(await page.locator('.scene [role="status"].unseen').textContent(), "Heading of vehicle 2: 68.0 deg");
});
