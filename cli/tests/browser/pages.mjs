// Tests that each page loads without errors, makes no requests outside the site, and has the common elements. Only a list of devices
// loads the search index before the reader searches.
import assert from "node:assert/strict";
import { pagesOf, sampled, Window, withBrowser } from "./browser.mjs";

const [site] = process.argv.slice(2);
const pages = pagesOf(site);
assert.ok(pages.length > 60, `only ${pages.length} pages`);

await withBrowser(async (browser) => {
  const window = await Window.open(browser, site);
  const opened = sampled(pages, 8);
  for (const place of opened) {
    window.requests.length = 0;
    const page = await window.go(place);
    assert.deepEqual(window.complaints, [], place);
    const isList = await page.locator("#devices").count() > 0;
    const loaded = window.requests.map((url) => url.split("/").pop()).filter((file) => !isList || !/^search(-first)?\.js$/.test(file)).sort();
    assert.deepEqual(loaded, [place.split("/").pop(), "site.css", "site.js"].sort(), place);
    const seen = await page.evaluate(() => ({
      headings: document.querySelectorAll("h1").length,
      title: document.title,
      open: [...document.querySelectorAll("#tree [aria-current=page]")].map((link) => link.href),
      has: document.querySelector("main").innerText.trim().length,
      styled: getComputedStyle(document.querySelector("header")).display,
      url: location.href,
    }));
    assert.equal(seen.headings, 1, place);
    assert.ok(seen.title.length > 2 && seen.has > 20, `${place} is empty`);
    assert.equal(seen.styled, "flex", `${place} has no style`);
    if (place !== "index.html") assert.deepEqual(seen.open, [seen.url], `${place}: the marked link is wrong`);
  }
  console.log(`${opened.length} of ${pages.length} pages`);
});
