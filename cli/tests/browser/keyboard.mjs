// Tests the use of pages with the keyboard: Tab follows the order of the page, the focus is visible, and the first link skips to the content.
import assert from "node:assert/strict";
import { Window, withBrowser } from "./browser.mjs";

const [site] = process.argv.slice(2);
await withBrowser(async (browser) => {
  for (const colorScheme of ["light", "dark"]) {
    const window = await Window.open(browser, site, { colorScheme });
    await order(window);
    await unfolds(window);
    await skips(window);
    window.clean();
    await window.close();
  }
  const phone = await Window.open(browser, site, { viewport: { width: 390, height: 844 } });
  await scrolls(phone);
  phone.clean();
});

async function order(window) {
  const page = await window.go("kollmorgen/akd/no-revision/profile-objects.html");
  const path = await page.locator(".path a").allTextContents();
  const links = await page.locator("#tree a").allTextContents();
  const rows = await page.locator("main .items :is(th button, th a, .object summary)").evaluateAll((items) => items.map((item) => item.textContent || item.title));
  const wanted = ["To the content", ...path, "search", "language", "theme", "filter", ...links, "Unfold all", ...rows];
  const seen = [];
  for (let at = 0; at < wanted.length; at++) {
    await page.keyboard.press("Tab");
    const focused = await page.evaluate(() => {
      const element = document.activeElement, { outlineStyle, outlineWidth } = getComputedStyle(element), place = element.getBoundingClientRect();
      return {
        name: element.id || element.textContent || element.title,
        isSeen: outlineStyle === "solid" && parseFloat(outlineWidth) >= 2,
        isInSight: place.width > 0 && place.bottom > 0 && place.top < innerHeight && place.right > 0,
      };
    });
    assert.ok(focused.isSeen, `${focused.name} has the focus, but no focus indicator`);
    assert.ok(focused.isInSight, `${focused.name} has the focus, but is not in view`);
    seen.push(focused.name);
  }
  assert.deepEqual(seen, wanted);
}

// The keyboard unfolds one row and all rows, and folds them again.
async function unfolds(window) {
  const page = await window.go("kollmorgen/akd/no-revision/profile-objects.html");
  const shown = () => page.locator(".items .more:visible").count();
  const all = await page.locator(".items .more").count();
  assert.equal(await shown(), 0);
  await page.locator(".fold").first().focus();
  for (const count of [1, 0]) {
    await page.keyboard.press("Enter");
    assert.equal(await shown(), count);
  }
  await page.locator(".unfold").focus();
  for (const count of [all, 0]) {
    await page.keyboard.press("Space");
    assert.equal(await shown(), count);
  }
  await window.go("kollmorgen/akd/no-revision/profile-objects.html#0x6041");
  assert.ok(await page.locator("[id='0x6041'] .more").isVisible(), "the row of the address is unfolded");
}

async function skips(window) {
  const page = await window.go("kollmorgen/akd/no-revision/profile-objects.html");
  await page.keyboard.press("Tab");
  await page.keyboard.press("Enter");
  await page.keyboard.press("Tab");
  assert.ok(await page.evaluate(() => document.querySelector("main").contains(document.activeElement)));
}

// Checks that arrow keys scroll content that is wider than a phone.
async function scrolls(window) {
  const page = await window.go("vendor-0x0000078f/eco/no-revision/states-and-procedures.html");
  const box = page.locator(".wide[tabindex='0']").first();
  await box.focus();
  await page.keyboard.press("ArrowRight");
  await page.waitForFunction(() => document.activeElement.scrollLeft > 0);
}
