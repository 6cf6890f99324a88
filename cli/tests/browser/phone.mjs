// Tests pages on a phone: no page is wider than the screen, and wide content scrolls in a box that the keyboard can reach.
// The header covers little of the screen, and tables have space for their texts.
// Byte grids contain the complete name of each entry.
import assert from "node:assert/strict";
import { pagesOf, sampled, Window, withBrowser } from "./browser.mjs";

const [site, networks] = process.argv.slice(2);
await withBrowser(async (browser) => {
  for (const width of [390, 320]) {
    const window = await Window.open(browser, site, { viewport: { width, height: 700 }, isMobile: true, hasTouch: true });
    let boxes = 0, grids = 0;
    for (const place of sampled(pagesOf(site), 3)) {
      const seen = await fits(window, place, width);
      grids += seen.grids;
      boxes += seen.scrolled;
    }
    assert.ok(grids > 2, `only ${grids} byte grids`);
    assert.ok(boxes > 2, `only ${boxes} boxes scroll`);
    window.clean();
    await window.close();
    const others = await Window.open(browser, networks, { viewport: { width, height: 700 }, isMobile: true, hasTouch: true });
    for (const place of pagesOf(networks).filter((place) => /^_(networks|segments)\//.test(place))) await fits(others, place, width);
    others.clean();
    await others.close();
  }
});

// Checks a page, and returns what was counted.
async function fits(window, place, width) {
  const page = await window.go(place);
  // The browser lays out content only when it becomes visible.
  const seen = await page.evaluate(() => {
    const style = new CSSStyleSheet();
    style.replaceSync("* { content-visibility: visible !important; }");
    document.adoptedStyleSheets = [style];
    const all = [...document.querySelectorAll("main :not(svg, svg *)")];
    const header = document.querySelector("header");
    // Text in a cell that has space for only one word in each line.
    const isSqueezed = (cell) => {
      const range = document.createRange();
      range.selectNodeContents(cell);
      const { width, height } = range.getBoundingClientRect();
      return width < 70 && height > 90;
    };
    return {
      width: document.documentElement.scrollWidth,
      lost: all.filter((item) => getComputedStyle(item).overflowX === "hidden").map((item) => item.outerHTML.slice(0, 80)),
      scrolled: all.filter((item) => item.matches(".wide, pre") && item.scrollWidth > item.clientWidth).length,
      covered: getComputedStyle(header).position === "sticky" ? header.offsetHeight / innerHeight : 0,
      squeezed: all.filter((item) => item.matches(":is(.list, .items, .fields) :is(td, th)") && isSqueezed(item)).map((item) => item.textContent),
      grids: document.querySelectorAll(".bytes").length,
      cut: all.filter((item) => item.matches(".bytes td") && item.scrollWidth > item.clientWidth).map((item) => item.textContent),
      unnamed: all.filter((item) => item.matches(".frame")).flatMap((frame) => {
        const names = new Set([...frame.querySelectorAll(".bytes td b")].map((name) => name.textContent));
        return [...frame.querySelectorAll(".list b")].map((name) => name.textContent).filter((name) => !names.has(name));
      }),
      letters: parseFloat(getComputedStyle(document.body).fontSize),
    };
  });
  assert.ok(seen.width <= width, `${place} is ${seen.width} wide on ${width}`);
  assert.deepEqual(seen.lost, [], place);
  assert.ok(seen.letters >= 14, place);
  assert.ok(seen.covered <= 0.15, `${place}: the header covers ${seen.covered} of the screen`);
  assert.deepEqual(seen.squeezed, [], place);
  assert.deepEqual(seen.cut, [], `${place}: names in byte grids are cut`);
  assert.deepEqual(seen.unnamed, [], `${place}: names are missing in byte grids`);
  return seen;
}
