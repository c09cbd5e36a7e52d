// Takes the picture of a report for the documentation:
//   NODE_PATH=build/release/web/node_modules node web/screenshot.cjs out/report.html docs/images/report.png [light|dark [PART]]
// PART, a selector, is all that is shown.
"use strict";
const path = require("node:path");
const { chromium } = require("playwright-core");

(async () => {
  const [, , page, picture, scheme = "light", part] = process.argv;
  const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: ["--no-sandbox"] });
  const view = await browser.newPage({ viewport: { width: 1280, height: 1180 }, deviceScaleFactor: 1.25, colorScheme: scheme });
  await view.goto("file://" + path.resolve(page));
  // What stays at the top of the window would lie over the part.
  if (part) await view.addStyleTag({ content: "header { position: static !important; }" });
  if (part) await view.locator(part).first().scrollIntoViewIfNeeded();
  await view.waitForTimeout(300);
  await (part ? view.locator(part).first() : view).screenshot({ path: picture });
  await browser.close();
})();
