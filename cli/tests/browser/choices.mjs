// Tests the choice of theme and language. The theme follows the system settings, both can be changed with the keyboard, and both persist on other pages.
import assert from "node:assert/strict";
import { Window, withBrowser } from "./browser.mjs";

const [site] = process.argv.slice(2);
await withBrowser(async (browser) => {
  await themes(browser, "light", "dark");
  await themes(browser, "dark", "light");
  await languages(browser);
});

async function themes(browser, system, other) {
  const window = await Window.open(browser, site, { colorScheme: system });
  const page = await window.go("vendor-0x0000078f/eco/no-revision/index.html");
  assert.equal(await brightness(page), system);
  for (const theme of [other, system, other]) {
    await page.locator("#theme").focus();
    await page.keyboard.press("Enter");
    assert.equal(await brightness(page), theme);
  }
  await window.go("kollmorgen/akd/no-revision/codes.html");
  assert.equal(await brightness(page), other, "the choice does not persist");
  window.clean();
  await window.close();
}

async function languages(browser) {
  const window = await Window.open(browser, site);
  const page = await window.go("aec-s-r-l/vector-step/no-revision/encoder-1.html");
  const row = page.locator("tbody[id=Renc1pulse] td").first();
  const shown = async () => (await row.locator("b:visible, i:visible").allInnerTexts()).join(" ");
  const choose = (language) => page.locator("#language").selectOption(language);
  assert.equal(await shown(), "Renc1pulse Impulsi giro encoder 1");
  await choose("-");
  assert.equal(await shown(), "Renc1pulse");
  await choose("it");
  assert.equal(await shown(), "Impulsi giro encoder 1");
  await window.go("aec-s-r-l/vector-step/no-revision/position-registers.html");
  assert.equal(await page.locator("#language").inputValue(), "it", "the choice does not persist");
  const named = await page.locator("tbody[id] > tr:first-child > td:nth-child(2)").allInnerTexts();
  assert.ok(named.length > 5 && named.every((name) => name.trim()), `a name is missing: ${named}`);
  await choose("");
  assert.ok((await page.locator("tbody[id=Rposact] td").first().innerText()).startsWith("Rposact Posizione"));
  // The tree shows one name of each message.
  await window.go("hsd-s-p-a/hsd-motor/no-revision/messages.html");
  const inTree = () => page.locator("#contents a[href='#CmdTraj']").innerText();
  assert.equal((await inTree()).trim(), "CmdTraj");
  await choose("it");
  assert.equal((await inTree()).trim(), "Posizionamento alla quota assegnata (LINE)");
  await choose("");
  // Select the next language with the keyboard.
  await page.locator("#language").focus();
  await page.keyboard.press("ArrowDown");
  assert.equal(await page.locator("#language").inputValue(), "-");
  window.clean();
}

// Returns the theme of the page according to its colors.
function brightness(page) {
  return page.evaluate(() => {
    const sum = (color) => color.match(/\d+/g).slice(0, 3).reduce((sum, part) => sum + Number(part), 0);
    const { backgroundColor, color } = getComputedStyle(document.body);
    return sum(backgroundColor) > sum(color) ? "light" : "dark";
  });
}
