// Faults that pages could have are noticed: a test of the other tests.
import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
import path from "node:path";
import { Window, withBrowser } from "./browser.mjs";

const policy = `<meta http-equiv="Content-Security-Policy" content="default-src 'none'">`;
const FAULTS = [
  ["an image from elsewhere", `<img src="http://192.0.2.1/x.png">`, "asks for http://192.0.2.1/x.png"],
  ["a file of another folder", `<img src="../outside.png">`, "asks for "],
  ["a file that is missing", `<script src="missing.js"></script>`, "doesn't get "],
  ["an error of a script", `<script>throw new Error("broken")</script>`, "an error of a script: Error: broken"],
  ["a promise that fails", `<script>Promise.reject(new Error("broken"))</script>`, "an error of a script: Error: broken"],
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
    const told = window.complaints.join("\n");
    assert.equal(complaint === "", told === "", `${what}: ${told}`);
    assert.ok(told.includes(complaint), `${what}: ${told}`);
    await window.close();
  }
});
