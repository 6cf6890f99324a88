// Tests the search for numbers in both notations, names in two languages, units and descriptions. The keyboard must select a result and open its row.
import assert from "node:assert/strict";
import { Window, withBrowser } from "./browser.mjs";

// Test cases: the page, the typed text, the expected first result, and the page that Enter opens.
const FOUND = [
  ["aec-s-r-l/vector-step/no-revision/index.html", "0x6040", /^0x6040 Controlword/, "aec-s-r-l/vector-step/no-revision/profile-objects.html#0x6040"],
  ["aec-s-r-l/vector-step/no-revision/index.html", "6040", /^0x6040 Controlword/, "aec-s-r-l/vector-step/no-revision/profile-objects.html#0x6040"],
  ["aec-s-r-l/vector-step/no-revision/index.html", "24640", /^0x6040 Controlword/, "aec-s-r-l/vector-step/no-revision/profile-objects.html#0x6040"],
  ["aec-s-r-l/vector-step/no-revision/index.html", "0x1403:01", /^0x1403:01 /, "aec-s-r-l/vector-step/no-revision/communication-objects.html#0x1403:01"],
  ["aec-s-r-l/vector-step/no-revision/index.html", "rposact", /^0x2000:01 Rposact/, "aec-s-r-l/vector-step/no-revision/position-registers.html#Rposact"],
  ["aec-s-r-l/vector-step/no-revision/codes.html", "impulsi giro encoder 1", /^0x4729:01 Renc1pulse object · Impulsi giro/, "aec-s-r-l/vector-step/no-revision/encoder-1.html#Renc1pulse"],
  ["hsd-s-p-a/hsd-motor/no-revision/index.html", "0x0105", /^parameter 0x0105 KP_VEL/, "hsd-s-p-a/hsd-motor/no-revision/parameters.html#KP_VEL"],
  ["hsd-s-p-a/hsd-motor/no-revision/index.html", "261", /^parameter 0x0105 KP_VEL/, "hsd-s-p-a/hsd-motor/no-revision/parameters.html#KP_VEL"],
  ["hsd-s-p-a/hsd-motor/no-revision/parameters.html", "velocita e della coppia", /^message Poll theoretical position Richiesta/, "hsd-s-p-a/hsd-motor/no-revision/messages.html#Poll_theoretical_position"],
  ["hsd-s-p-a/hsd-motor/no-revision/index.html", "low_level maximum current V", /^low_level 0x0005 KIQDLIMAX V · HSD Motor$/, "hsd-s-p-a/hsd-motor/no-revision/low-level-parameters.html#KIQDLIMAX"],
  ["hsd-s-p-a/hsd-motor/no-revision/index.html", "overheated", /^0x0001 overheated code · ALOVERHEATED/, "hsd-s-p-a/hsd-motor/no-revision/codes.html#alarm-0x0001"],
  // The next texts are codes as printed in the manual or in one of its cells, and register numbers that the manual prints next to an index.
  ["kollmorgen/akd/no-revision/index.html", "F125", /^F125 synchronization lost/, "kollmorgen/akd/no-revision/codes.html#faults-F125"],
  ["vendor-0x0000078f/eco/no-revision/index.html", "0x8700 synchronization", /^34 synchronization timed out/, "vendor-0x0000078f/eco/no-revision/codes.html#ethercat_alarms-34"],
  ["aec-s-r-l/vector-step/no-revision/index.html", "register 63", /^register 63–64 Rvel/, "aec-s-r-l/vector-step/no-revision/motion-parameters.html#Rvel"],
  ["vendor-0x0000078f/eco/no-revision/index.html", "32848", /^register R80 \(wire 0x8050\) mechatronic_80/, "vendor-0x0000078f/eco/no-revision/registers.html#mechatronic_80"],
  ["vendor-0x0000078f/eco/no-revision/index.html", "0x8050", /^register R80 \(wire 0x8050\) mechatronic_80/, "vendor-0x0000078f/eco/no-revision/registers.html#mechatronic_80"],
  ["kollmorgen/akd/no-revision/index.html", "valore di comando di velocità", /^0x60FF Velocity command value/, "kollmorgen/akd/no-revision/profile-objects.html#0x60FF"],
  // The code 0x8642 is within a range of codes.
  ["vendor-0x0000078f/eco/no-revision/index.html", "0x8642", /^0x8000 to 0x8FFF monitoring/, "vendor-0x0000078f/eco/no-revision/codes.html#emergency-0x8000_to_0x8FFF"],
  // The first page searches all devices. One of the words is the name of the device.
  ["index.html", "akd 60ff", /^0x60FF Velocity command value .*AKD$/, "kollmorgen/akd/no-revision/profile-objects.html#0x60FF"],
  // A bit with a condition, and a value of such a bit.
  ["index.html", "vector homing operation start", /^bit 4 homing operation start/, "aec-s-r-l/vector-step/no-revision/profile-objects.html#0x6040.bit-4-homing-operation-start"],
  ["index.html", "vector counterclockwise", /^bit 5 counterclockwise/, "aec-s-r-l/vector-step/no-revision/profile-objects.html#0x6040.bit-5-jog-direction.value-1"],
  ["index.html", "KP_VEL", /^parameter 0x0105 KP_VEL .*HSD Motor$/, "hsd-s-p-a/hsd-motor/no-revision/parameters.html#KP_VEL"],
];

// Test cases for the site with modules: name, ident number in three notations, and the whole name of a submodule.
const DRIVE = "example/servo-head-0x00000002/no-revision/";
const MODULES = "example/_files/drive-gsdml/";
const FOUND_MODULES = [
  [DRIVE + "index.html", "axis", /^0x00000030 Axis module/, MODULES + "modules.html#module-00000030"],
  [DRIVE + "index.html", "0x00000030", /^0x00000030 Axis module/, MODULES + "modules.html#module-00000030"],
  [DRIVE + "index.html", "30h", /^0x00000030 Axis module/, MODULES + "modules.html#module-00000030"],
  [DRIVE + "index.html", "48", /^0x00000030 Axis module/, MODULES + "modules.html#module-00000030"],
  [MODULES + "modules.html", "standard telegram 3", /^0x00000003 Standard telegram 3 module/, MODULES + "modules.html#submodule-00000003"],
];

const [site, modular, many] = process.argv.slice(2);
await withBrowser(async (browser) => {
  const modules = await Window.open(browser, modular);
  await finds(modules, FOUND_MODULES);
  modules.clean();
  const lists = await Window.open(browser, many);
  await otherPages(lists);
  lists.clean();
  const window = await Window.open(browser, site);
  await loadsWhenIdle(window);
  await firstPart(window);
  await enterBeforeTheIndex(window);
  await focusAfterTheIndex(window);
  await finds(window, FOUND);
  await units(window);
  await arrows(window);
  await nothing(window);
  window.clean();
  await missingIndex(await Window.open(browser, site));
});

// Checks the first result of each test case, and the page that Enter opens.
async function finds(window, cases) {
  for (const [from, typed, first, to] of cases) {
    const page = await window.go(from);
    const found = await window.search(typed);
    assert.match(found[0], first, `${typed}: ${found.slice(0, 3).join(" | ")}`);
    await page.keyboard.press("Enter");
    await page.waitForURL((url) => decodeURIComponent(url.href).endsWith(to));
    if (to.includes("#")) await landed(window, `${typed} on ${from}`);
  }
}

// Checks that the row in the address is visible below the fixed header, and that Tab continues from this row.
async function landed(window, what) {
  const { page } = window;
  await page.waitForFunction(() => document.querySelector(":target, .target"));
  const place = await page.evaluate(() => {
    const row = document.querySelector(":target, .target").getBoundingClientRect();
    return { top: row.top, header: document.querySelector("header").getBoundingClientRect().bottom, height: innerHeight };
  });
  assert.ok(place.top >= place.header - 1 && place.top < place.height - 20, `${what}: ${JSON.stringify(place)}`);
  await page.keyboard.press("Tab");
  const goesOn = await page.evaluate(() => {
    const row = document.querySelector(":target");
    return !row || row.contains(document.activeElement) || !row.querySelector("a");
  });
  assert.ok(goesOn, `${what}: Tab does not continue from the row`);
}

// Checks that a list of devices loads the index before the reader searches. Then, a letter is answered without another request.
async function loadsWhenIdle(window) {
  const page = await window.go("index.html");
  await page.waitForFunction(() => isLoaded);
  const requests = window.requests.length;
  assert.equal((await window.search("KP_VEL")).length, 1);
  assert.equal(window.requests.length, requests);
  await page.keyboard.press("Escape");
}

// Checks that the first part of the index answers before the whole index is loaded, and that the selected result stays selected then.
async function firstPart(window) {
  let release;
  const held = new Promise((resolve) => { release = resolve; });
  await window.context.route(/search\.js$/, async (route) => { await held; await route.continue(); });
  const page = await window.go("index.html");
  await page.keyboard.press("/");
  await page.keyboard.type("target");
  await page.waitForSelector("#found li");
  const shown = await page.locator("#found li").allTextContents();
  assert.ok(shown.some((text) => /target/i.test(text)), shown.join("\n"));
  assert.ok(!await page.evaluate(() => isLoaded));
  await page.keyboard.press("ArrowDown");
  const selected = () => page.locator("#found [aria-selected=true]").getAttribute("href");
  const before = await selected();
  release();
  await page.waitForFunction(() => isLoaded);
  const after = await page.locator("#found a").evaluateAll((links) => links.map((link) => link.getAttribute("href")));
  assert.ok(after.length >= shown.length, `${after.length} results of the whole index, ${shown.length} before`);
  assert.ok(after.includes(before), `${before} is missing: ${after.join("\n")}`);
  assert.equal(await selected(), before);
  await page.keyboard.press("Escape");
  await window.context.unroute(/search\.js$/);
}

// Opens the list of devices, types a text and calls `test` before the whole index is loaded. `release` lets the browser load the index.
async function beforeTheIndex(window, typed, test) {
  let release;
  const held = new Promise((resolve) => { release = resolve; });
  await window.context.route(/search\.js$/, (route) => held.then(() => route.continue()).catch(() => { /* The page is left. */ }));
  const page = await window.go("index.html");
  await page.keyboard.press("/");
  await page.keyboard.type(typed);
  await page.waitForFunction(() => pages.length);
  await test(page, release);
  release();
  await window.context.unroute(/search\.js$/);
}

// Loads the whole index. The page must stay.
async function load(page, release) {
  release();
  await page.waitForFunction(() => isLoaded);
}

// Checks what Enter does before the whole index is loaded.
async function enterBeforeTheIndex(window) {
  const isAtList = async (page) => {
    await page.waitForTimeout(200);
    return page.url().endsWith("index.html") && page.evaluate(() => Boolean(deviceFilter));
  };
  // A selected result is opened at once.
  await beforeTheIndex(window, "target", async (page) => {
    await page.keyboard.press("ArrowDown");
    const chosen = await page.locator("#found [aria-selected=true]").evaluate((link) => link.href);
    await page.keyboard.press("Enter");
    await page.waitForURL(chosen);
  });
  // Another selection, Escape and leaving the field cancel Enter.
  for (const key of ["ArrowDown", "ArrowUp", "Escape", "Tab"]) {
    await beforeTheIndex(window, "target", async (page, release) => {
      await page.keyboard.press("Enter");
      await page.keyboard.press(key);
      if (key === "Escape") await page.keyboard.press("/");
      await load(page, release);
      if (key === "Tab") await page.keyboard.press("/");
      assert.ok(await isAtList(page), `${key} does not cancel Enter`);
    });
  }
  // Enter opens the first result if the whole index has no better one.
  await beforeTheIndex(window, "vector step", async (page, release) => {
    const first = await page.locator("#found a").first().evaluate((link) => link.href);
    await page.keyboard.press("Enter");
    // The page may be left as soon as the index is loaded.
    release();
    await page.waitForURL(first);
  });
  // Enter is dropped if the first result changes. The test changes the result of the first part.
  await beforeTheIndex(window, "target", async (page, release) => {
    await page.evaluate(() => { found.querySelector("a").href = "another.html"; });
    await page.keyboard.press("Enter");
    await load(page, release);
    assert.ok(await isAtList(page), "Enter opens another result");
    assert.ok(await page.locator("#found li").first().isVisible());
  });
  // The first part has no similar words, because the whole index may have the word.
  await beforeTheIndex(window, "targat", async (page, release) => {
    assert.equal(await page.locator("#found li").count(), 0);
    await load(page, release);
    assert.ok(await page.locator("#found li").count() > 0, "the whole index has similar words");
  });
}

// Checks that the results are those of the whole index after a focus, if the index was loaded while the reader was elsewhere.
async function focusAfterTheIndex(window) {
  await beforeTheIndex(window, "KP_VEL", async (page, release) => {
    await page.keyboard.press("Escape");
    await load(page, release);
    assert.ok(await page.locator("#found").isHidden());
    await page.keyboard.press("/");
    assert.ok(await page.locator("#found").isVisible(), "no search after the focus");
    assert.match(await page.locator("#found li").first().innerText(), /KP_VEL/);
  });
}

// Checks that Enter opens a result of the first part if the whole index cannot be loaded.
async function missingIndex(window) {
  await window.context.route(/search\.js$/, (route) => route.abort());
  const page = await window.go("index.html");
  await page.keyboard.press("/");
  await page.keyboard.type("target");
  const link = page.locator("#found a").first();
  await link.waitFor();
  const first = await link.evaluate((link) => link.href);
  await page.keyboard.press("Enter");
  await page.waitForURL(first);
  await window.close();
}

// Checks that the filter of a long list also finds devices on the other pages of the list.
async function otherPages(window) {
  const page = await window.go("index.html");
  await page.fill("#devices", "terminal 299");
  await page.waitForFunction(() => document.querySelector("#elsewhere li"));
  assert.equal(await page.locator("#shown").innerText(), "0 devices on this page");
  const links = page.locator("#elsewhere a");
  assert.equal(await links.count(), 1);
  await links.click();
  assert.match(await page.locator("h1").innerText(), /^Terminal 299 /);
  await window.go("devices-2.html");
  await page.fill("#devices", "terminal 299");
  assert.equal(await page.locator("#shown").innerText(), "1 device on this page");
  assert.ok(await page.locator("#elsewhere").isHidden());
  await page.fill("#devices", "");
  await page.getByRole("link", { name: /Devices \(1 of 2\)$/ }).first().click();
  await page.waitForURL(/index\.html$/);
}

// Checks that a unit finds the registers with that unit, independent of their names.
async function units(window) {
  await window.go("vendor-0x0000078f/eco/no-revision/index.html");
  const found = await window.search("rpm");
  const counted = found.filter((entry) => entry.endsWith(" rpm · Eco"));
  assert.ok(counted.length >= 8 && counted.some((entry) => entry.startsWith("0x606C:00 velocity_actual_value")), found.join("\n"));
}

// Checks that arrow keys select a result, that the selection is announced, and that Escape or leaving the field closes the list.
async function arrows(window) {
  const page = await window.go("vendor-0x0000078f/eco/no-revision/index.html");
  const found = await window.search("homing");
  assert.ok(found.length > 3);
  const chosen = () => page.evaluate(() => [
    [...document.querySelectorAll("#found a")].findIndex((entry) => entry.getAttribute("aria-selected") === "true"),
    document.getElementById("search").getAttribute("aria-activedescendant"),
    document.getElementById("search").getAttribute("aria-expanded"),
  ]);
  assert.deepEqual(await chosen(), [0, "found-0", "true"]);
  for (const [key, at] of [["ArrowDown", 1], ["ArrowDown", 2], ["ArrowUp", 1]]) {
    await page.keyboard.press(key);
    assert.deepEqual(await chosen(), [at, `found-${at}`, "true"]);
  }
  for (let at = 0; at < 60; at++) await page.keyboard.press("ArrowDown");
  assert.equal((await chosen())[0], found.length - 1);
  assert.ok(await page.locator("#found li").last().isVisible());
  await page.keyboard.press("Escape");
  assert.ok(await page.locator("#found").isHidden());
  await window.search("homing");
  await page.keyboard.press("Tab");
  assert.ok(await page.locator("#found").isHidden(), "the list stays open");
}

async function nothing(window) {
  const page = await window.go("vendor-0x0000078f/eco/no-revision/index.html");
  assert.deepEqual(await window.search("no such thing"), []);
  assert.equal(await page.getByRole("status").innerText(), "Nothing found.");
  assert.ok(await page.locator("#found").isHidden());
}
