// Tests the diagrams of state machines: no arrow crosses a label or a box, labels do not overlap, and nothing is outside the drawing.
// Each box shows the name and the bit pattern of its state. A status value highlights the box of its state.
import assert from "node:assert/strict";
import { pagesOf, Window, withBrowser } from "./browser.mjs";

const [site] = process.argv.slice(2);
await withBrowser(async (browser) => {
  const window = await Window.open(browser, site);
  let count = 0;
  for (const place of pagesOf(site).filter((place) => place.endsWith("/states-and-procedures.html"))) {
    const page = await window.go(place);
    for (const diagram of await page.locator("svg.states").all()) {
      count += 1;
      assert.deepEqual(await diagram.evaluate(overlaps), [], place);
    }
  }
  assert.ok(count >= 5, `only ${count} diagrams`);
  const page = await window.go("aec-s-r-l/vector-step/no-revision/states-and-procedures.html");
  const box = page.locator("svg.states .state", { hasText: "operation enabled" });
  assert.deepEqual(await box.locator("text").allTextContents(), ["operation enabled", "xxxx xxxx x01x 0111"]);
  await page.getByLabel("Status value").first().fill("0x1237");
  assert.deepEqual(await page.locator("svg.states .on").allTextContents(), await box.allTextContents());
  window.clean();
});

// Returns the pairs of parts that overlap. Paths consist of horizontal and vertical lines.
function overlaps(svg) {
  const origin = svg.getBoundingClientRect(), found = [];
  const rectangle = (element) => {
    const { left, top, right, bottom } = element.getBoundingClientRect();
    return { what: element.textContent, left: left - origin.left, top: top - origin.top, right: right - origin.left, bottom: bottom - origin.top };
  };
  const lines = [...svg.querySelectorAll(":scope > path")].flatMap((path) => {
    let [x, y] = [0, 0];
    return [...path.getAttribute("d").matchAll(/([MHV])(\d+)(?: (\d+))?/g)].flatMap(([, command, first, second]) => {
      const from = [x, y];
      if (command === "V") y = Number(first); else x = Number(first);
      if (command === "M") y = Number(second);
      const what = path.getAttribute("d");
      return command === "M" ? [] : [{ what, left: Math.min(from[0], x), right: Math.max(from[0], x), top: Math.min(from[1], y), bottom: Math.max(from[1], y) }];
    });
  });
  const labels = [...svg.querySelectorAll(":scope > text")].map(rectangle), boxes = [...svg.querySelectorAll(".state")].map(rectangle);
  const meet = (a, b, rim) => a.left < b.right - rim && b.left < a.right - rim && a.top < b.bottom - rim && b.top < a.bottom - rim;
  const check = (ones, others, rim) => {
    for (const one of ones) for (const other of others) if (one !== other && meet(one, other, rim)) found.push([one.what, other.what]);
  };
  check(lines, labels, 0);
  check(lines, boxes, 4);
  check(labels, [...labels, ...boxes], 1);
  const frame = { left: 0, top: 0, right: origin.width, bottom: origin.height };
  for (const part of [...labels, ...boxes]) {
    if (part.left < frame.left || part.top < frame.top || part.right > frame.right || part.bottom > frame.bottom) found.push([part.what, "the edge"]);
  }
  for (const path of svg.querySelectorAll(".state")) {
    const texts = [...path.querySelectorAll("text")].map(rectangle), [outer] = [path.querySelector("rect")].map(rectangle);
    for (const text of texts) if (text.left < outer.left || text.right > outer.right) found.push([text.what, "its box"]);
  }
  return found;
}
