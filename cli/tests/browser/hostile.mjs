// Tests that pages, search results and comparisons show markup in descriptions as text. The markup must not run scripts or load files.
import assert from "node:assert/strict";
import { pagesOf, Window, withBrowser } from "./browser.mjs";

const OWN = { "diff.html": [] };

const [site] = process.argv.slice(2);
await withBrowser(async (browser) => {
  const window = await Window.open(browser, site);
  let shown = 0;
  for (const place of pagesOf(site)) {
    await window.go(place);
    const seen = await look(window);
    // A list of devices loads the index when it is idle.
    const scripts = seen.scripts.filter((script) => !/^search(-first)?\.js$/.test(script) || !seen.isList);
    assert.deepEqual(scripts, OWN[place] ?? ["site.js"], place);
    assert.deepEqual([seen.handlers, seen.images], [0, 0], place);
    shown += seen.texts;
  }
  assert.ok(shown > 60, `only ${shown} texts are shown`);
  await window.go("diff.html");
  assert.match(await window.page.innerText("h1"), /^<img src=x onerror=alert\(5\)> old\.toml → <img/);
  assert.ok((await look(window)).texts > 5);
  await search(window);
  await window.page.waitForTimeout(300);
  window.clean();
});

// Returns the elements that markup in a description could add to the page, and the number of texts that contain the markup.
function look(window) {
  return window.page.evaluate(() => {
    const all = [...document.querySelectorAll("*")], texts = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    let count = 0;
    while (texts.nextNode()) count += Number(texts.currentNode.data.includes("alert("));
    return {
      scripts: [...document.scripts].map((item) => item.src.split("/").pop()),
      handlers: all.filter((item) => item.getAttributeNames().some((name) => name.startsWith("on"))).length,
      images: document.querySelectorAll("img, iframe, object, embed, form, base, link:not([rel=stylesheet])").length,
      texts: count,
      isList: document.getElementById("devices") !== null,
    };
  });
}

async function search(window) {
  for (const place of ["index.html", pagesOf(site).find((place) => place.endsWith("/messages.html"))]) {
    const page = await window.go(place);
    const found = await window.search("onerror=alert");
    assert.ok(found.length >= 3 && found.every((item) => item.includes("<img src=x onerror=alert")), found.join("\n"));
    assert.deepEqual(await page.evaluate(() => [...new Set([...document.querySelectorAll("#found *")].map((item) => item.tagName))].sort()), ["A", "LI", "SMALL"]);
    await page.locator('#found a[href*="#"]').first().click();
    await page.waitForURL(/#/);
    await page.waitForFunction(() => document.querySelector(":target"));
  }
}
