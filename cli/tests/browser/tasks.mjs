// Fifteen tasks of a commissioning engineer, from the first page of the site. Each task has its maximum number of keys and clicks.
import assert from "node:assert/strict";
import { Window, withBrowser } from "./browser.mjs";

const [drives, terminals] = process.argv.slice(2);

// Counts the actions of the reader.
class Reader {
  constructor(window) {
    this.window = window;
    this.page = window.page;
    this.count = 0;
  }

  async type(text) {
    await this.page.keyboard.type(text);
    this.count += [...text].length;
  }

  async press(key) {
    await this.page.keyboard.press(key);
    this.count += 1;
  }

  async click(locator) {
    await locator.click();
    this.count += 1;
  }

  // Opens the first result of a search, which must have this name.
  async search(text, name) {
    await this.press("/");
    await this.type(text);
    await this.page.waitForFunction((name) => document.querySelector("#found a")?.textContent.includes(name), name);
    const before = this.page.url();
    await this.press("Enter");
    await this.page.waitForURL((url) => url.href !== before);
  }

  // Opens the first result, which must be an item.
  async find(text, name) {
    await this.search(text, name);
    await this.page.waitForFunction(() => document.querySelector(".items > tbody.open"));
  }

  // Returns the lines of the requests, which a page shows after they are unfolded.
  async requests() {
    const lines = this.row().locator(".requests code");
    await lines.first().waitFor();
    return lines.allInnerTexts();
  }

  row() {
    return this.page.locator(".items > tbody.open");
  }
}

const TASKS = {
  "What does the raw value 0x1237 of the status word of the AKD mean?": [17, async (reader) => {
    await reader.find("akd 6041", "0x6041 Status word");
    await reader.click(reader.row().locator(".raw"));
    await reader.type("0x1237");
    const set = await reader.row().locator(".fields .on b").allInnerTexts();
    assert.deepEqual(set, ["ready to switch on", "switched on", "operation enabled", "voltage enabled"]);
  }],
  "What is the raw value of -12.5 rev/s in Rvel?": [12, async (reader) => {
    await reader.find("rvel", "Rvel");
    await reader.click(reader.row().locator(".physical"));
    await reader.type("-12.5");
    assert.equal(await reader.row().locator(".raw").inputValue(), "-1250");
    assert.equal(await reader.row().locator("output").innerText(), "-1250 = 0xFFFFFB1E");
  }],
  "Which bytes write -12.5 rev/s to Rvel over CANopen and over Modbus?": [13, async (reader) => {
    await reader.find("rvel", "Rvel");
    await reader.click(reader.row().locator(".physical"));
    await reader.type("-12.5");
    await reader.click(reader.row().locator(".requests summary"));
    const lines = await reader.requests();
    assert.ok(lines.includes("601  23 3F 20 01 1E FB FF FF"), lines.join("\n"));
    assert.ok(lines.includes("01 10 00 3F 00 02 04 FB 1E FF FF E0 69"), lines.join("\n"));
  }],
  "The status word of the AKD is 0x1231. Which command enables the drive?": [22, async (reader) => {
    await reader.search("akd fault rea", "fault reaction active");
    const drive = reader.page.locator("section.machine[id=drive]");
    await reader.click(drive.locator(".status"));
    await reader.type("0x1231");
    assert.equal(await drive.locator("output").innerText(), "ready to switch on");
    assert.deepEqual(await drive.locator("svg .state.on text:not(.pattern)").allTextContents(), ["ready to switch on"]);
    assert.ok((await drive.locator(".next li").allInnerTexts()).includes("operation enabled: switch on (0x0007), then enable operation (0x000F)"));
  }],
  "Which byte of the PROFINET image carries the alarm code of the Eco?": [16, async (reader) => {
    await reader.find("eco alarm_code", "alarm_code");
    const facts = await reader.row().innerText();
    assert.match(facts, /Process image: to the master, byte 7\b/);
  }],
  "What is the remedy of alarm 10 of the HSD motor?": [14, async (reader) => {
    await reader.search("hsd alarm 10", "0x000A no parameters in flash");
    assert.match(await reader.page.locator(":target").innerText(), /send the parameters again and store them/);
  }],
  "Which SDOs map 0x6064 into TPDO 2 of node 5?": [27, async (reader) => {
    await reader.search("vector tpdo 2", "TPDO 2");
    const builder = reader.page.locator(".builder");
    await reader.page.getByLabel("PDO", { exact: true }).selectOption({ label: "TPDO 2 / TxPDO 0x1A01" });
    reader.count += 2;
    await reader.click(builder.getByText("Clear"));
    await reader.click(builder.getByLabel("Node-ID"));
    await reader.press("Backspace");
    await reader.type("5");
    await reader.click(builder.getByLabel("Object to map"));
    await reader.type("6064");
    await reader.press("Enter");
    assert.deepEqual((await builder.locator("code").first().innerText()).split("\n"), [
      "605  23 01 18 01 85 02 00 80", "605  2F 01 1A 00 00 00 00 00", "605  23 01 1A 01 20 00 64 60", "605  2F 01 1A 00 01 00 00 00",
      "605  23 01 18 01 85 02 00 00",
    ]);
  }],
  "Which request reads register R80 of the Eco with the unit 3?": [13, async (reader) => {
    await reader.find("eco r80", "R80");
    await reader.click(reader.row().locator(".requests summary"));
    await reader.click(reader.row().getByLabel("Modbus unit"));
    await reader.press("Backspace");
    await reader.type("3");
    const lines = await reader.requests();
    assert.ok(lines.includes("03 03 80 50 00 02 EC 38"), lines.join("\n"));
  }],
  "Which assumptions about the HSD motor can move it?": [12, async (reader) => {
    await reader.search("hsd assump", "Assumptions");
    const first = reader.page.locator("main details").first();
    assert.match(await first.locator("summary").innerText(), /Can move a motor/);
    assert.ok(await first.locator("tr").count() > 5);
  }],
  "What is the maximum of PIMAX_VEL on the SM140?": [11, async (reader) => {
    await reader.find("pimax_vel", "PIMAX_VEL");
    assert.match(await reader.row().innerText(), /On SM140:.* 35\.00 A/);
  }],
  "Which low-level parameter has the same quantity as PIMAX_I?": [10, async (reader) => {
    await reader.find("pimax_i", "PIMAX_I");
    await reader.click(reader.row().locator(".links a", { hasText: "KIQDLIMAX" }));
    await reader.page.waitForFunction(() => document.querySelector("#KIQDLIMAX.open"));
  }],
  "How does the Vector Step store its registers?": [16, async (reader) => {
    await reader.search("save_registers", "save registers");
    assert.match(await reader.page.locator(":target").innerText(), /Rloadsav/);
  }],
  "Which line of Python reads 0x6064 of the Vector Step?": [14, async (reader) => {
    await reader.find("vector 6064", "0x6064 Position actual value");
    await reader.click(reader.row().locator(".requests summary"));
    assert.ok((await reader.requests()).includes("node.sdo.upload(0x6064, 0)"));
  }],
};

const OF_TERMINALS = {
  "Which terminal has the product code 0x04C22C52, and what is its newest revision?": [5, async (reader) => {
    await reader.click(reader.page.locator("#devices"));
    await reader.type("04c2");
    const rows = reader.page.locator(".devices tbody tr:not(.family):visible");
    assert.deepEqual(await rows.locator("th").allInnerTexts(), ["T1218 counter", "T1218 counter"]);
    assert.match(await rows.first().innerText(), /0x00120000/);
  }],
  "What changed between the two revisions of the terminal T1218?": [15, async (reader) => {
    await reader.search("t1218 changes", "Changes since revision 0x00110000");
    const rows = await reader.page.locator("main tbody tr").allInnerTexts();
    assert.ok(rows.some((row) => /0x7010:01 .*UNSIGNED16.*UNSIGNED32/s.test(row)), rows.join("\n"));
  }],
};

async function solveAll(browser, site, tasks) {
  const window = await Window.open(browser, site);
  for (const [title, [limit, solve]] of Object.entries(tasks)) {
    await window.go("index.html");
    const reader = new Reader(window);
    await solve(reader);
    assert.ok(reader.count <= limit, `${title}: ${reader.count} keys and clicks`);
    console.log(`${reader.count} of ${limit}: ${title}`);
  }
  window.clean();
  await window.close();
}

await withBrowser(async (browser) => {
  await solveAll(browser, drives, TASKS);
  await solveAll(browser, terminals, OF_TERMINALS);
});
