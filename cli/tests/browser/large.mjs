// Tests a site with 2,000 registers of eight fields each: the sizes of its files are limited, and the search finds and shows the last
// register. Prints the times for loading and searching, and the size of the site.
import assert from "node:assert/strict";
import { readdirSync, statSync } from "node:fs";
import path from "node:path";
import { pagesOf, Window, withBrowser } from "./browser.mjs";

const [site] = process.argv.slice(2);
const size = (name) => statSync(path.join(site, name)).size;
const pages = pagesOf(site);
assert.ok(size("unknown-vendor/_files/large/search.js") < 300_000, `an index of ${size("unknown-vendor/_files/large/search.js")} bytes`);
for (const page of pages) assert.ok(size(page) < 300_000, `${page}: ${size(page)} bytes`);

await withBrowser(async (browser) => {
  const window = await Window.open(browser, site);
  await window.go("index.html");
  const start = performance.now();
  await window.go("unknown-vendor/large/no-revision/registers.html");
  const loaded = performance.now();
  const found = await window.search("register_1999");
  const answered = performance.now();
  assert.match(found[0], /^register 1999 register_1999/);
  // The first page can load the index before the reader leaves it.
  const others = window.requests.filter((url) => !url.endsWith("/search.js"));
  assert.equal(others.length, 3 + 3, window.requests.join("\n"));
  await window.page.keyboard.press("Enter");
  await window.page.waitForURL(/registers-\d+\.html#register_1999$/);
  await window.page.waitForFunction(() => document.querySelector(":target")?.getBoundingClientRect().top < innerHeight);
  const elements = await window.page.evaluate(() => document.querySelectorAll("*").length);
  assert.ok(elements < 50_000, `${elements} elements`);
  window.clean();
  const interactive = await fastest(window, "unknown-vendor/large/no-revision/registers.html");
  const total = readdirSync(site, { recursive: true, withFileTypes: true }).filter((file) => file.isFile());
  const bytes = total.reduce((sum, file) => sum + statSync(path.join(file.parentPath ?? file.path, file.name)).size, 0);
  assert.ok(bytes < 3_500_000, `a site of ${bytes} bytes`);
  const took = (from, to) => `${Math.round(to - from)} ms`;
  console.log(`a page of 500 registers: ${took(start, loaded)}; 13 keys to the first result: ${took(loaded, answered)}; ${elements} elements; interactive after ${interactive} ms; ${(bytes / 1e6).toFixed(2)} MB`);
});

// Returns the shortest time of five loads until the page is interactive: it is complete and its script has run.
async function fastest(window, place) {
  const times = [];
  for (let run = 0; run < 5; run++) {
    const page = await window.go(place);
    times.push(await page.evaluate(() => performance.getEntriesByType("navigation")[0].domContentLoadedEventEnd));
  }
  return Math.round(Math.min(...times));
}
