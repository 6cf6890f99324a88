// Tasks of a commissioning engineer, from the first page of the site. Each task counts its keys and clicks, and must not need more than
// before.
import assert from "node:assert/strict";
import { Window, withBrowser } from "./browser.mjs";

const [site] = process.argv.slice(2);

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

  // Opens the first result of a search with this name.
  async find(text, name) {
    await this.press("/");
    await this.type(text);
    await this.page.waitForFunction((name) => document.querySelector("#found a")?.textContent.includes(name), name);
    await this.press("Enter");
    await this.page.waitForFunction(() => document.querySelector(".items > tbody.open"));
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
    const lines = await reader.row().locator(".requests code").allInnerTexts();
    assert.ok(lines.includes("601  23 3F 20 01 1E FB FF FF"), lines.join("\n"));
    assert.ok(lines.includes("01 10 00 3F 00 02 04 FB 1E FF FF E0 69"), lines.join("\n"));
  }],
  "The status word of the AKD is 0x1231. Which command enables the drive?": [22, async (reader) => {
    await reader.press("/");
    await reader.type("akd fault_rea");
    await reader.page.waitForFunction(() => document.querySelector("#found a")?.textContent.includes("fault_reaction_active"));
    await reader.press("Enter");
    await reader.page.waitForFunction(() => document.querySelector("section.machine .status"));
    const drive = reader.page.locator("section.machine[id=drive]");
    await reader.click(drive.locator(".status"));
    await reader.type("0x1231");
    assert.equal(await drive.locator("output").innerText(), "ready_to_switch_on");
    assert.deepEqual(await drive.locator("svg .state.on").allTextContents(), ["ready_to_switch_on"]);
    assert.ok((await drive.locator(".next li").allInnerTexts()).includes("operation_enabled: switch_on (0x0007)"));
  }],
  "Which byte of the PROFINET image carries the alarm code of the Eco?": [16, async (reader) => {
    await reader.find("eco alarm_code", "alarm_code");
    const facts = await reader.row().innerText();
    assert.match(facts, /Process image: to the master, bytes? \d+/);
  }],
};

await withBrowser(async (browser) => {
  const window = await Window.open(browser, site);
  for (const [title, [limit, solve]] of Object.entries(TASKS)) {
    await window.go("index.html");
    const reader = new Reader(window);
    await solve(reader);
    assert.ok(reader.count <= limit, `${title}: ${reader.count} keys and clicks`);
    console.log(`${reader.count} of ${limit}: ${title}`);
  }
  window.clean();
});
