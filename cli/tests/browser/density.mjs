// Tests that a 1080p screen shows at least 20 lines of each kind of list: items, codes, states, assumptions and process data.
import assert from "node:assert/strict";
import { Window, withBrowser } from "./browser.mjs";

const LISTS = [
  ["aec-s-r-l/vector-step/no-revision/communication-objects.html", ".items > tbody"],
  ["aec-s-r-l/vector-step/no-revision/states-and-procedures.html", ".list tr"],
  ["vendor-0x0000078f/eco/no-revision/registers.html", ".items > tbody"],
  ["vendor-0x0000078f/eco/no-revision/profile-objects.html", ".items > tbody"],
  ["vendor-0x0000078f/eco/no-revision/codes.html", ".list tr"],
  ["hsd-s-p-a/hsd-motor/no-revision/codes.html", ".list tr"],
  ["hsd-s-p-a/hsd-motor/no-revision/parameters.html", ".items > tbody"],
  ...["vendor-0x0000078f/eco", "hsd-s-p-a/hsd-motor", "aec-s-r-l/vector-step", "kollmorgen/akd"].map((device) => [`${device}/no-revision/assumptions.html`, ".items > tbody"]),
  // A line of process data or of a state machine is a heading, a row, or the first line of an ambiguity.
  ...["vendor-0x0000078f/eco", "aec-s-r-l/vector-step", "kollmorgen/akd"].map((device) => [`${device}/no-revision/process-data.html`, ":is(h2, .list tr, .bytes tr, summary)"]),
  ...["vendor-0x0000078f/eco", "hsd-s-p-a/hsd-motor", "kollmorgen/akd"].map((device) => [`${device}/no-revision/states-and-procedures.html`, ":is(h2, .list tr, summary)"]),
];

const [site] = process.argv.slice(2);
await withBrowser(async (browser) => {
  const window = await Window.open(browser, site, { viewport: { width: 1920, height: 1080 } });
  for (const [place, lines] of LISTS) {
    const page = await window.go(place);
    const seen = await page.locator(`main ${lines}`).evaluateAll((all) => all.filter((line) => line.getBoundingClientRect().bottom <= innerHeight).length);
    assert.ok(seen >= 20, `${place}: ${seen} lines`);
  }
  window.clean();
});
