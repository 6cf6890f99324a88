// Tests that each page loads without errors, makes no requests outside the site, and has the common elements. Only a list of devices
// loads the search index before the reader searches.
import assert from "node:assert/strict";
import { pagesOf, sampled, Window, withBrowser } from "./browser.mjs";

const [drives, networks] = process.argv.slice(2);
await withBrowser(async (browser) => {
  await loads(browser, drives, 60);
  await loads(browser, networks, 20);
});

// Opens every eighth page of a site, which has more than `least` pages, and the pages of its networks. The full lane opens all pages.
async function loads(browser, site, least) {
  const pages = pagesOf(site), window = await Window.open(browser, site);
  assert.ok(pages.length > least, `only ${pages.length} pages`);
  const opened = new Set([...sampled(pages, 8), ...pages.filter((place) => /^_(networks|segments)\//.test(place))]);
  for (const place of opened) await opens(window, place);
  console.log(`${opened.size} of ${pages.length} pages`);
  await window.close();
}

async function opens(window, place) {
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
    contents: document.querySelectorAll("#contents a").length,
    url: location.href,
  }));
  assert.equal(seen.headings, 1, place);
  assert.ok(seen.title.length > 2 && seen.has > 20, `${place} is empty`);
  assert.equal(seen.styled, "flex", `${place} has no style`);
  if (place !== "index.html") assert.deepEqual(seen.open, [seen.url], `${place}: the marked link is wrong`);
  if (place.startsWith("_")) assert.ok(seen.contents > 1, `${place}: the tree has no contents of the page`);
}
