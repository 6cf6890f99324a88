// Tests printed pages: they show the name of the device, have dark text on white in both themes, and contain no controls.
// Folded texts are printed, and numbers stay in one line. A long page has few sheets, and no sheet is empty.
import assert from "node:assert/strict";
import { inflateSync } from "node:zlib";
import { pagesOf, sampled, Window, withBrowser } from "./browser.mjs";

const [site] = process.argv.slice(2);
await withBrowser(async (browser) => {
  for (const colorScheme of ["light", "dark"]) {
    const window = await Window.open(browser, site, { colorScheme, viewport: { width: 718, height: 1000 } });
    const page = await window.go("aec-s-r-l/vector-step/no-revision/profile-objects.html");
    await page.locator("#theme").click();
    await page.emulateMedia({ media: "print" });
    const seen = await page.evaluate(() => {
      const style = (selector) => getComputedStyle(document.querySelector(selector));
      return {
        back: style("body").backgroundColor,
        text: style("body").color,
        heading: style(".items thead").display,
        drawn: style("svg.bits").display,
        width: document.documentElement.scrollWidth,
      };
    });
    assert.equal(seen.back, "rgb(255, 255, 255)");
    assert.ok(seen.text.match(/\d+/g).every((part) => Number(part) < 64), seen.text);
    assert.deepEqual([seen.heading, seen.drawn], ["table-header-group", "block"]);
    assert.ok(seen.width <= 718, `${seen.width} wide`);
    assert.deepEqual(await page.locator("header a:visible").allInnerTexts(), ["Vector Step", "Profile objects"]);
    for (const control of ["#tree", "#search", "#theme", "#language", ".fold", ".unfold"]) {
      assert.ok(await page.locator(control).first().isHidden(), `${control} is printed`);
    }
    assert.ok((await page.pdf({ format: "A4" })).length > 10_000);
    await complete(window);
    await isShort(window);
    window.clean();
    await window.close();
  }
  const window = await Window.open(browser, site);
  await hasNoEmptySheets(window);
  window.clean();
  await noticesAnEmptySheet(await browser.newPage());
});

async function complete(window) {
  const page = await window.go("hsd-s-p-a/hsd-motor/no-revision/codes.html");
  const folded = page.locator("main details:not([open])");
  const count = await folded.count();
  assert.ok(count > 0, "no ambiguities are folded");
  await page.evaluate(() => dispatchEvent(new Event("beforeprint")));
  assert.equal(await folded.count(), 0);
  const broken = await page.locator("tbody th a").evaluateAll((links) => links.filter((link) => link.getClientRects().length > 1).map((link) => link.textContent));
  assert.deepEqual(broken, [], "codes are broken");
  await page.evaluate(() => dispatchEvent(new Event("afterprint")));
  assert.equal(await folded.count(), count);
}

// Checks the number of sheets of a page with all its details, with the default margins of the browser.
async function isShort(window) {
  const page = await window.go("vendor-0x0000078f/eco/no-revision/registers.html"), margin = "0.4in";
  const document = await page.pdf({ format: "A4", margin: { top: margin, right: margin, bottom: margin, left: margin } });
  const sheets = document.toString("latin1").match(/\/Type\s*\/Page\b/g).length;
  assert.ok(sheets > 4 && sheets <= 12, `${sheets} sheets`);
}

// Checks that each printed sheet contains text.
async function hasNoEmptySheets(window) {
  for (const place of sampled(pagesOf(site), 3)) {
    const page = await window.go(place), texts = textsOf(await page.pdf({ format: "A4" }));
    assert.ok(texts.length && texts.every((count) => count > 0), `${place}: texts on its sheets: ${texts}`);
  }
}

async function noticesAnEmptySheet(page) {
  await page.setContent("<p>first</p><hr style='break-before: page'><p style='break-before: page'>third</p>");
  assert.deepEqual(textsOf(await page.pdf()).map((count) => count > 0), [true, false, true]);
}

// Returns the number of texts on each sheet of a PDF.
function textsOf(pdf) {
  const text = pdf.toString("latin1");
  return [...text.matchAll(/\/Type\s*\/Page\b[^]*?\/Contents (\d+) 0 R/g)].map(([, number]) => {
    const start = text.indexOf("stream\n", text.indexOf(`\n${number} 0 obj`)) + "stream\n".length;
    return inflateSync(pdf.subarray(start)).toString("latin1").match(/\bT[jJ]\b/g)?.length ?? 0;
  });
}
