// Takes the screenshots of the README: node test/screenshots.js
import { mkdirSync } from "node:fs";
import { join } from "node:path";

import { ROOT, close, open } from "./browser.js";

const folder = join(ROOT, "docs", "images");
mkdirSync(folder, { recursive: true });

for (const [name, options, prepare] of [
  ["page", { viewport: { width: 1280, height: 800 } }, async () => undefined],
  [
    "page-dark",
    { viewport: { width: 1280, height: 800 }, colorScheme: "dark" },
    async (page) => {
      await page.getByRole("tab", { name: "Text", exact: true }).click();
      await page.getByRole("tab", { name: "Sensitivity" }).click();
    },
  ],
]) {
  const { page, context } = await open(options);
  await prepare(page);
  await page.mouse.move(1, 799);
  await page.screenshot({ path: join(folder, `${name}.png`), animations: "disabled" });
  await context.close();
}
await close();
