// Takes screenshots of every kind of page for a review: in both themes, on a desktop, a phone and paper.
import { mkdirSync } from "node:fs";
import path from "node:path";
import { Window, withBrowser } from "./browser.mjs";

// Pages of the drives: name, path, and text that is typed into the search.
const DRIVES = [
  ["devices", "index.html"],
  ["overview", "vendor-0x0000078f/eco/no-revision/index.html"],
  ["bits", "aec-s-r-l/vector-step/no-revision/profile-objects.html#0x6041"],
  ["registers", "vendor-0x0000078f/eco/no-revision/parameters.html"],
  ["process-data", "vendor-0x0000078f/eco/no-revision/process-data.html"],
  ["machines", "aec-s-r-l/vector-step/no-revision/states-and-procedures.html"],
  ["messages", "hsd-s-p-a/hsd-motor/no-revision/messages.html#CmdTraj"],
  ["codes", "hsd-s-p-a/hsd-motor/no-revision/codes.html"],
  ["assumptions", "hsd-s-p-a/hsd-motor/no-revision/assumptions.html"],
  ["search", "vendor-0x0000078f/eco/no-revision/index.html", "speed"],
];

// Pages of EtherCAT terminals, and of a coupler with modules.
const TERMINALS = [
  ["changes", "example-terminals/t1218-counter-0x04c22c52/0x00120000/changes.html"],
  ["comparison", "_compare/old-to-terminals.html"],
];
const COUPLER = [
  ["diagnostics", "example/_files/coupler-esi/diagnostics.html"],
  ["modules", "example/_files/coupler-esi/modules.html"],
];


// Pages of a PROFINET station, and of a CANopen network and an EtherCAT segment.
const STATION = [
  ["access-point", "example/safe-head-0x00000001/no-revision/index.html"],
  ["records", "example/_files/safe-gsdml/modules.html"],
];
const NETWORKS = [
  ["network", "_networks/packaging-line.html"],
  ["segment", "_segments/segment.html"],
];

const SCREENS = {
  desktop: { viewport: { width: 1280, height: 900 } },
  phone: { viewport: { width: 390, height: 844 }, isMobile: true, hasTouch: true },
  print: { viewport: { width: 718, height: 1000 } },
};

async function take(browser, site, pictures, folder) {
  for (const colorScheme of ["light", "dark"]) {
    for (const [screen, options] of Object.entries(SCREENS)) {
      const window = await Window.open(browser, site, { colorScheme, ...options });
      // The search is not printed.
      for (const [name, place, typed] of pictures.filter(([, , typed]) => !typed || screen !== "print")) {
        const page = await window.go(place);
        if (screen === "print") await page.emulateMedia({ media: "print" });
        if (screen === "print") await page.evaluate(() => dispatchEvent(new Event("beforeprint")));
        if (typed) await window.search(typed);
        await page.screenshot({ path: path.join(folder, `${name}-${screen}-${colorScheme}.png`) });
      }
      window.clean();
      await window.close();
    }
  }
}

const [drives, terminals, coupler, station, networks, folder] = process.argv.slice(2);
mkdirSync(folder, { recursive: true });
await withBrowser(async (browser) => {
  await take(browser, drives, DRIVES, folder);
  await take(browser, terminals, TERMINALS, folder);
  await take(browser, coupler, COUPLER, folder);
  await take(browser, station, STATION, folder);
  await take(browser, networks, NETWORKS, folder);
  console.log(`pictures are in ${path.resolve(folder)}`);
});
