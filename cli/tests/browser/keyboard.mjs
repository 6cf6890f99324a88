// Tab moves through a page in order, the focus is visible, and the first link skips to the content.
import assert from "node:assert/strict";
import { Window, withBrowser } from "./browser.mjs";

const [site] = process.argv.slice(2);
await withBrowser(async (browser) => {
  for (const colorScheme of ["light", "dark"]) {
    const window = await Window.open(browser, site, { colorScheme });
    await order(window);
    await skips(window);
    window.clean();
    await window.close();
  }
  const phone = await Window.open(browser, site, { viewport: { width: 390, height: 844 } });
  await scrolls(phone);
  phone.clean();
});

async function order(window) {
  const page = await window.go("kollmorgen-akd/profile-objects.html");
  const links = await page.locator("nav a").allTextContents();
  const rows = await page.locator("main .items th a").allTextContents();
  const wanted = ["To the content", "All devices", "search", "language", "theme", ...links, ...rows];
  const seen = [];
  for (let at = 0; at < 3 * wanted.length && !seen.includes(rows[rows.length - 1]); at++) {
    await page.keyboard.press("Tab");
    const focused = await page.evaluate(() => {
      const element = document.activeElement, { outlineStyle, outlineWidth } = getComputedStyle(element), place = element.getBoundingClientRect();
      return {
        name: element.id || element.textContent,
        isSeen: outlineStyle === "solid" && parseFloat(outlineWidth) >= 2,
        isInSight: place.width > 0 && place.bottom > 0 && place.top < innerHeight && place.right > 0,
      };
    });
    assert.ok(focused.isSeen, `${focused.name} has the focus, but no focus indicator`);
    assert.ok(focused.isInSight, `${focused.name} has the focus, but is not in view`);
    if (focused.name !== "Copy") seen.push(focused.name);
  }
  assert.deepEqual(seen, wanted);
}

async function skips(window) {
  const page = await window.go("kollmorgen-akd/profile-objects.html");
  await page.keyboard.press("Tab");
  await page.keyboard.press("Enter");
  await page.keyboard.press("Tab");
  assert.ok(await page.evaluate(() => document.querySelector("main").contains(document.activeElement)));
}

// Arrow keys scroll content that is wider than a phone.
async function scrolls(window) {
  const page = await window.go("eco/states-and-procedures.html");
  const box = page.locator(".wide[tabindex='0']").first();
  await box.focus();
  await page.keyboard.press("ArrowRight");
  await page.waitForFunction(() => document.activeElement.scrollLeft > 0);
}
