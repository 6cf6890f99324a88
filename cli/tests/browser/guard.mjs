// Tests that the other scripts detect pages with errors.
import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
import path from "node:path";
import { Window, withBrowser } from "./browser.mjs";

const policy = `<meta http-equiv="Content-Security-Policy" content="default-src 'none'">`;
const FAULTS = [
  ["an image from elsewhere", `<img src="http://192.0.2.1/x.png">`, "requests http://192.0.2.1/x.png"],
  ["a file of another folder", `<img src="../outside.png">`, "requests "],
  ["a file that is missing", `<script src="missing.js"></script>`, "failed to load "],
  ["a script error", `<script>throw new Error("broken")</script>`, "a script error: Error: broken"],
  ["a promise that fails", `<script>Promise.reject(new Error("broken"))</script>`, "a script error: Error: broken"],
  ["an error on the console", `<script>console.error("broken")</script>`, "console: broken"],
  ["a dialog", `<script>alert("hello")</script>`, "a dialog: hello"],
  ["a script that the page's policy forbids", `${policy}<script>1</script>`, "console: "],
  ["a style that the page's policy forbids", `${policy}<p style="color: red">x</p>`, "console: "],
];

const [site] = process.argv.slice(2);
await withBrowser(async (browser) => {
  for (const [what, markup, complaint] of [...FAULTS, ["nothing", "<p>fine</p>", ""]]) {
    writeFileSync(path.join(site, "page.html"), `<!doctype html><title>x</title>${markup}`);
    const window = await Window.open(browser, site);
    await window.go("page.html");
    await window.page.waitForTimeout(100);
    const reported = window.complaints.join("\n");
    assert.equal(complaint === "", reported === "", `${what}: ${reported}`);
    assert.ok(reported.includes(complaint), `${what}: ${reported}`);
    await window.close();
  }
});
