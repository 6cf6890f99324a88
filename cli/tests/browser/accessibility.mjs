// Tests pages of every kind with axe-core: names, labels, headings, roles and contrast, in both themes and on a phone.
import assert from "node:assert/strict";
import { axe, pagesOf, Window, withBrowser } from "./browser.mjs";

const DESKTOP = { width: 1280, height: 800 }, PHONE = { width: 390, height: 844 };

const PAGES = [
  "index.html", "vendor-0x0000078f/eco/no-revision/index.html", "vendor-0x0000078f/eco/no-revision/process-data.html", "vendor-0x0000078f/eco/no-revision/states-and-procedures.html", "vendor-0x0000078f/eco/no-revision/parameters.html", "hsd-s-p-a/hsd-motor/no-revision/codes.html",
  "hsd-s-p-a/hsd-motor/no-revision/states-and-procedures.html", "aec-s-r-l/vector-step/no-revision/alarms-and-warnings.html", "kollmorgen/akd/no-revision/messages.html",
  "kollmorgen/akd/no-revision/profile-objects.html#0x6040",
];

const [site, networks] = process.argv.slice(2);
const pages = process.env.LEXIBUS_LANE === "full" ? pagesOf(site) : PAGES;
await withBrowser(async (browser) => {
  for (const colorScheme of ["light", "dark"]) {
    for (const viewport of colorScheme === "light" ? [DESKTOP, PHONE] : [DESKTOP]) {
      const window = await Window.open(browser, site, { colorScheme, viewport });
      for (const place of pages) {
        await window.go(place);
        await examine(window.page, `${place}, ${colorScheme}, ${viewport.width} wide`);
      }
      await window.go("vendor-0x0000078f/eco/no-revision/parameters.html");
      await window.page.locator(".unfold").click();
      await examine(window.page, `unfolded details, ${colorScheme}, ${viewport.width} wide`);
      await window.go("vendor-0x0000078f/eco/no-revision/index.html");
      await window.search("speed");
      await examine(window.page, `the search, ${colorScheme}, ${viewport.width} wide`);
      window.clean();
      await window.close();
      await examineNetworks(browser, { colorScheme, viewport });
    }
  }
});

// Examines the pages of networks and segments, and the list of devices that leads to them.
async function examineNetworks(browser, { colorScheme, viewport }) {
  const window = await Window.open(browser, networks, { colorScheme, viewport });
  const places = pagesOf(networks).filter((place) => /^(index\.html|_networks\/|_segments\/)/.test(place));
  assert.equal(places.length, 3, places.join("\n"));
  for (const place of places) {
    await window.go(place);
    await examine(window.page, `${place}, ${colorScheme}, ${viewport.width} wide`);
  }
  window.clean();
  await window.close();
}

async function examine(page, what) {
  await browsed(page);
  await page.evaluate(axe);
  const violations = await page.evaluate(async () => {
    const { violations, passes } = await axe.run(document, { preload: false, resultTypes: ["violations", "passes"] });
    const examined = passes.find((rule) => rule.id === "color-contrast")?.nodes.length ?? 0;
    if (!examined) return ["no contrast was examined"];
    return violations.map(({ impact, id, help, nodes }) => `${impact}: ${help} (${id}), ${nodes.length} times, as in ${nodes[0].html.slice(0, 200)}`);
  });
  assert.deepEqual(violations, [], what);
}

// Makes the browser lay out the whole page, including the content that is not in view.
async function browsed(page) {
  await page.evaluate(async () => {
    const style = new CSSStyleSheet(), frame = () => new Promise(requestAnimationFrame);
    style.replaceSync("* { content-visibility: visible !important; }");
    document.adoptedStyleSheets = [style];
    for (let at = 0; at < 3; at++) await frame();
  });
}
