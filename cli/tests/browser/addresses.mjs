// Tests that a link to a row opens the page with that row, from any page of the device.
import assert from "node:assert/strict";
import { Window, withBrowser } from "./browser.mjs";

const [site, alone] = process.argv.slice(2);
await withBrowser(async (browser) => {
  const window = await Window.open(browser, site);
  await leads(window, "aec-s-r-l/vector-step/no-revision/index.html#0x6040", "aec-s-r-l/vector-step/no-revision/profile-objects.html#0x6040");
  await leads(window, "aec-s-r-l/vector-step/no-revision/codes.html#0x6040", "aec-s-r-l/vector-step/no-revision/profile-objects.html#0x6040");
  // The first entry is in the row of its object, and the second entry has a separate row.
  await leads(window, "aec-s-r-l/vector-step/no-revision/index.html#0x6040:00", "aec-s-r-l/vector-step/no-revision/profile-objects.html#0x6040");
  await leads(window, "aec-s-r-l/vector-step/no-revision/index.html#0x1403:01", "aec-s-r-l/vector-step/no-revision/communication-objects.html#0x1403:01");
  await leads(window, "aec-s-r-l/vector-step/no-revision/index.html#0x607a", "aec-s-r-l/vector-step/no-revision/profile-objects.html#0x607A");
  await leads(window, "hsd-s-p-a/hsd-motor/no-revision/index.html#KP_VEL", "hsd-s-p-a/hsd-motor/no-revision/parameters.html#KP_VEL");
  await leads(window, "index.html#Renc1pulse", "aec-s-r-l/vector-step/no-revision/encoder-1.html#Renc1pulse");
  // The page of the newest revision keeps the address.
  await leads(window, "kollmorgen/akd/latest/index.html#0x6040", "kollmorgen/akd/no-revision/profile-objects.html#0x6040");
  await leads(window, "aec-s-r-l/vector-step/no-revision/index.html#0x6040.bit-4-jog", "aec-s-r-l/vector-step/no-revision/profile-objects.html#0x6040.bit-4-jog");
  await showsPart(window);
  await showsPartOfEqualType(window);
  await changes(window);
  await stays(window);
  window.clean();
  await window.close();

  const other = await Window.open(browser, alone);
  await leads(other, "index.html#0x6040", "demo-drive-0x00004021/0x00010000/profile-objects.html#0x6040");
  other.clean();
});

async function leads(window, from, to) {
  const page = await window.go(from);
  await page.waitForURL((url) => decodeURIComponent(url.href).endsWith(to));
  await page.waitForFunction(() => document.querySelector(":target"));
}

// Checks that the address of a value of a bit unfolds the row and shows the value.
async function showsPart(window) {
  const page = await window.go("aec-s-r-l/vector-step/no-revision/profile-objects.html#0x6040.bit-4-jog.value-1");
  const value = page.locator(".target");
  await value.waitFor();
  assert.deepEqual([await value.innerText(), await value.evaluate((term) => term.nextElementSibling.textContent)], ["1", "start"]);
}

// Checks the address of a bit in a row that refers to another row for its bits.
async function showsPartOfEqualType(window) {
  const page = await window.go("vendor-0x0000078f/eco/no-revision/profile-objects.html");
  const address = await page.evaluate(() => {
    const reference = document.querySelector(".same a"), source = decodeURIComponent(reference.hash.slice(1));
    const part = document.getElementById(source).querySelector(".more [id]");
    return reference.closest("tbody").id + part.id.slice(source.length);
  });
  for (const from of ["profile-objects.html", "index.html"]) {
    await window.go(`vendor-0x0000078f/eco/no-revision/${from}#${address}`);
    await page.locator(".target").waitFor();
    assert.equal(await page.locator(".target").getAttribute("id"), address, from);
  }
}

// Changes the address of an open page to a row of another page.
async function changes(window) {
  const page = await window.go("kollmorgen/akd/no-revision/index.html");
  await page.evaluate(() => { location.hash = "#0x6040"; });
  await page.waitForURL(/profile-objects\.html#0x6040$/);
}

// Checks that an unknown address opens no other page and causes no error.
async function stays(window) {
  for (const hash of ["#0xDEAD", "#%", "#%FF%FE", "#<script>", "#", "#content"]) {
    const page = await window.go("vendor-0x0000078f/eco/no-revision/index.html" + hash);
    await page.waitForTimeout(300);
    assert.ok(page.url().includes("vendor-0x0000078f/eco/no-revision/index.html"), `${hash} leads to ${page.url()}`);
  }
}
