// Texts of descriptions that try to be markup are shown as what they are: nothing of them runs, loads or asks, in pages, in the list of
// the search, and in what `lexibus diff` writes.
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
    assert.deepEqual(seen.scripts, OWN[place] ?? ["site.js"], place);
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

// What of the page could be of a description.
function look(window) {
  return window.page.evaluate(() => {
    const all = [...document.querySelectorAll("*")], texts = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    let count = 0;
    while (texts.nextNode()) count += Number(texts.currentNode.data.includes("alert("));
    return {
      scripts: [...document.scripts].map((own) => own.src.split("/").pop()),
      handlers: all.filter((own) => own.getAttributeNames().some((name) => name.startsWith("on"))).length,
      images: document.querySelectorAll("img, iframe, object, embed, form, base, link:not([rel=stylesheet])").length,
      texts: count,
    };
  });
}

async function search(window) {
  for (const place of ["index.html", "table/index.html"]) {
    const page = await window.go(place);
    const found = await window.search("onerror=alert");
    assert.ok(found.length >= 3 && found.every((own) => own.includes("<img src=x onerror=alert")), found.join("\n"));
    assert.deepEqual(await page.evaluate(() => [...new Set([...document.querySelectorAll("#found *")].map((own) => own.tagName))].sort()), ["A", "LI", "SMALL"]);
    await page.keyboard.press("Enter");
    await page.waitForURL(/#/);
    await page.waitForFunction(() => document.querySelector(":target"));
  }
}
