// Takes screenshots of every kind of page for a review: in both themes, and on a desktop and a phone.
import { mkdirSync } from "node:fs";
import path from "node:path";
import { Window, withBrowser } from "./browser.mjs";

const PICTURES = [
  ["devices", "index.html"],
  ["overview", "vendor-0x0000078f/eco/no-revision/index.html"],
  ["bits", "aec-s-r-l/vector-step/no-revision/profile-objects.html#0x6041"],
  ["registers", "vendor-0x0000078f/eco/no-revision/parameters.html"],
  ["process-data", "vendor-0x0000078f/eco/no-revision/process-data.html"],
  ["machines", "aec-s-r-l/vector-step/no-revision/states-and-procedures.html"],
  ["messages", "hsd-s-p-a/hsd-motor/no-revision/messages.html#CmdTraj"],
  ["codes", "hsd-s-p-a/hsd-motor/no-revision/codes.html"],
  ["search", "vendor-0x0000078f/eco/no-revision/index.html", "speed"],
];

const [site, folder] = process.argv.slice(2);
mkdirSync(folder, { recursive: true });
await withBrowser(async (browser) => {
  for (const colorScheme of ["light", "dark"]) {
    for (const [screen, options] of [["desktop", { viewport: { width: 1280, height: 900 } }], ["phone", { viewport: { width: 390, height: 844 }, isMobile: true, hasTouch: true }]]) {
      const window = await Window.open(browser, site, { colorScheme, ...options });
      for (const [name, place, typed] of PICTURES) {
        await window.go(place);
        if (typed) await window.search(typed);
        await window.page.screenshot({ path: path.join(folder, `${name}-${screen}-${colorScheme}.png`) });
      }
      window.clean();
      await window.close();
    }
  }
  console.log(`pictures are in ${path.resolve(folder)}`);
});
