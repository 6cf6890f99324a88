// Tests pages on a phone: no page is wider than the screen, and wide content scrolls in a box that the keyboard can reach.
import assert from "node:assert/strict";
import { pagesOf, sampled, Window, withBrowser } from "./browser.mjs";

const [site] = process.argv.slice(2);
await withBrowser(async (browser) => {
  for (const width of [390, 320]) {
    const window = await Window.open(browser, site, { viewport: { width, height: 700 }, isMobile: true, hasTouch: true });
    let boxes = 0;
    for (const place of sampled(pagesOf(site), 3)) {
      const page = await window.go(place);
      // The browser lays out content only when it becomes visible.
      const seen = await page.evaluate(() => {
        const style = new CSSStyleSheet();
        style.replaceSync("* { content-visibility: visible !important; }");
        document.adoptedStyleSheets = [style];
        const all = [...document.querySelectorAll("main :not(svg, svg *)")];
        return {
          width: document.documentElement.scrollWidth,
          lost: all.filter((item) => getComputedStyle(item).overflowX === "hidden").map((item) => item.outerHTML.slice(0, 80)),
          scrolled: all.filter((item) => item.matches(".wide, pre") && item.scrollWidth > item.clientWidth).length,
          letters: parseFloat(getComputedStyle(document.body).fontSize),
        };
      });
      assert.ok(seen.width <= width, `${place} is ${seen.width} wide on ${width}`);
      assert.deepEqual(seen.lost, [], place);
      assert.ok(seen.letters >= 14, place);
      boxes += seen.scrolled;
    }
    assert.ok(boxes > 10, `only ${boxes} boxes scroll`);
    window.clean();
    await window.close();
  }
});
