// Types queries into the search field of a site's first page. Measures two times per keystroke: until the event handlers end, and until the page is drawn.
import { statSync } from "node:fs";
import path from "node:path";
import { pagesOf, Window, withBrowser } from "../cli/tests/browser/browser.mjs";

const QUERIES = [
  "0x6040", "24640", "6040", "control word", "velocity", "velocità", "rpm", "target position rpm", "motor overload", "akd mode", "1 2 3 4",
  "0x0000000c", "a e i o u", "no such thing",
];

const [site] = process.argv.slice(2);
const size = (name) => `${(statSync(path.join(site, name)).size / 1e6).toFixed(1)} MB`;
console.log(`${pagesOf(site).length} pages, an index of ${size("search.js")}, its first part ${size("search-first.js")}`);

await withBrowser(async (browser) => {
  const window = await Window.open(browser, site);
  for (const query of ["v", "6"]) {
    const open = () => window.go("index.html");
    const openAndWait = async () => {
      await open();
      await window.page.waitForFunction(() => isLoaded, undefined, { timeout: 10_000 });
      await window.page.waitForTimeout(1000);
    };
    console.log(`first result for ${query}, typed as soon as the page is loaded: ${await firstResults(window.page, query, open)}`);
    console.log(`first result for ${query}, typed when the page has been idle: ${await firstResults(window.page, query, openAndWait)}`);
  }
  const page = await window.go("index.html");
  await page.evaluate(measure);
  await firstResult(page, "v");
  const all = [];
  for (const query of QUERIES) {
    await page.fill("#search", "");
    await page.waitForTimeout(100);
    await page.evaluate(() => { times.length = 0; });
    for (const letter of query) {
      await page.keyboard.type(letter);
      await page.waitForTimeout(50);
    }
    await page.waitForFunction((count) => times.length >= count, query.length);
    const times = await page.evaluate(() => times);
    all.push(...times);
    console.log(`${query.padEnd(20)} worst ${shown(worst(times))}   ${await page.locator("#found li").count()} shown`);
  }
  console.log(`${all.length} keystrokes: median ${shown(median(all))}, worst ${shown(worst(all))}`);
  window.clean();
});

// Returns the time from the first letter to the first drawn result, measured in the page.
async function firstResult(page, letter) {
  await page.evaluate(() => {
    let start = 0;
    document.getElementById("search").addEventListener("keydown", () => { start ||= performance.now(); });
    window.first = new Promise((resolve) => {
      new MutationObserver((_, observer) => {
        observer.disconnect();
        requestAnimationFrame(() => setTimeout(() => resolve(performance.now() - start)));
      }).observe(document.getElementById("found"), { childList: true });
    });
  });
  await page.keyboard.press("/");
  await page.keyboard.type(letter);
  return page.evaluate(() => first);
}

// Returns the shortest and the longest of five times to the first result, after `prepare` has opened the first page.
async function firstResults(page, letter, prepare) {
  const times = [];
  for (let run = 0; run < 5; run++) {
    await prepare();
    times.push(Math.round(await firstResult(page, letter)));
  }
  return `${Math.min(...times)} to ${Math.max(...times)} ms`;
}

// Adds event listeners to the page that record both times of each keystroke in `window.times`.
function measure() {
  window.times = [];
  const input = document.getElementById("search");
  let start = 0;
  document.addEventListener("input", () => { start = performance.now(); }, true);
  document.addEventListener("input", () => {
    const begin = start, handled = performance.now() - begin, { port1, port2 } = new MessageChannel();
    port1.onmessage = () => { times.push([handled, performance.now() - begin]); };
    requestAnimationFrame(() => port2.postMessage(input.value));
  });
}

function worst(times) {
  return [0, 1].map((at) => Math.max(...times.map((sample) => sample[at])));
}

function median(times) {
  return [0, 1].map((at) => times.map((sample) => sample[at]).sort((one, other) => one - other)[times.length >> 1]);
}

function shown([handled, drawn]) {
  return `${handled.toFixed(0)} ms, drawn after ${drawn.toFixed(0)} ms`;
}
