// Tests that the decoder's conversions are inverse to each other and reject values that do not fit. The frames must have the
// form that the standards define. The PDO builder changes the order of objects, and maps
// objects on CANopen and EtherCAT. Requests for PROFINET records contain the whole record.
import assert from "node:assert/strict";
import { Window, withBrowser } from "./browser.mjs";

const [site, ethercat, station] = process.argv.slice(2);
await withBrowser(async (browser) => {
  const window = await Window.open(browser, site);
  const page = await window.go("vendor-0x0000078f/eco/no-revision/registers.html");
  const failed = await page.evaluate(() => {
    const failed = [], check = (holds, ...what) => { if (!holds) failed.push(what.map(String).join(" ")); };
    const random = (bits) => BigInt.asUintN(bits, crypto.getRandomValues(new BigUint64Array(1))[0]);
    for (const bits of [1, 3, 8, 12, 16, 24, 32, 48, 64]) {
      for (const isSigned of [false, true]) {
        const type = { bits, isSigned };
        for (const raw of [0n, (1n << BigInt(bits)) - 1n, 1n << BigInt(bits - 1), ...Array.from({ length: 50 }, () => random(bits))]) {
          for (const text of [String(numberOf(type, raw)), hexOf(type, raw), "0b" + raw.toString(2), raw.toString(16) + "h"]) {
            check(rawFrom(text, type) === raw, bits, isSigned, text, rawFrom(text, type));
          }
        }
        check(rawFrom(String(1n << BigInt(bits)), type) === undefined, bits, "too large");
        check(rawFrom(String(-(1n << BigInt(bits)) - 1n), type) === undefined, bits, "too small");
      }
    }
    for (const bits of [32, 64]) {
      const type = { bits, isReal: true };
      for (const number of [0, -1.5, 0.1, 3e30, -(2 ** -20)]) {
        const raw = rawOfReal(type, number), exact = bits === 32 ? Math.fround(number) : number;
        check(realFrom(type, raw) === exact && rawFrom(String(number), type) === raw, bits, number);
      }
    }
    for (const text of ["", " ", "x", "0x", "1.5", "--1", "0b2", "12g"]) check(rawFrom(text, { bits: 32 }) === undefined, "text", text);
    return failed;
  });
  assert.deepEqual(failed, []);
  const frames = await page.evaluate(() => ({
    // The example of the Modbus standard: reads 3 registers from address 107 of unit 17.
    modbus: bytesText(withCrc([0x11, 0x03, 0x00, 0x6B, 0x00, 0x03])),
    expedited: sdoDownload([0x40, 0x60, 0x00], [0x0F, 0x00]).map(bytesText),
    segmented: sdoDownload([0x10, 0x20, 0x01], [1, 2, 3, 4, 5, 6, 7, 8]).map(bytesText),
  }));
  assert.equal(frames.modbus, "11 03 00 6B 00 03 76 87");
  assert.deepEqual(frames.expedited, ["2B 40 60 00 0F 00 00 00"]);
  assert.deepEqual(frames.segmented, ["21 10 20 01 08 00 00 00", "00 01 02 03 04 05 06 07", "1D 08 00 00 00 00 00 00"]);
  await requestsOfBuses(page);
  await movesObjects(window);
  await showsBytes(window);
  window.clean();
  await window.close();
  const other = await Window.open(browser, ethercat);
  await mapsOnEthercat(other);
  other.clean();
  const records = await Window.open(browser, station);
  await writesRecords(records);
  records.clean();
});

// Checks the requests of an object with other access rights on a bus, and of 16-bit values in two registers.
async function requestsOfBuses(page) {
  const found = await page.evaluate(() => {
    const row = { canRead: true, canWrite: true, hasValue: true, bytes: [0x00, 0x90], raw: 0x9000n, node: 1, unit: 1 };
    const titles = (buses, rights = {}) => objectRequests([24640, 0, buses], { ...row, ...rights }).map(([title]) => title.replace(/ \(.*/, ""));
    const written = (flags) => modbusRequests(["h", 16, 2, flags, "3/16"], row).find(([title]) => title === "Modbus RTU write")[1];
    return {
      both: titles("ce"),
      readOnly: titles("cre"),
      nothing: titles("crwe-"),
      writable: titles("cerw", { canWrite: false }),
      noValue: titles("cerw", { canWrite: false, hasValue: false }),
      unsigned: written("-"),
      signed: written("x"),
    };
  });
  const [canopen, ethercat] = [["SDO upload", "canopen read"], ["pysoem read"]];
  const [toCanopen, toEthercat] = [["SDO download", "canopen write"], ["pysoem write"]];
  assert.deepEqual(found.both, [...canopen, ...toCanopen, ...ethercat, ...toEthercat]);
  assert.deepEqual(found.readOnly, [...canopen, ...ethercat, ...toEthercat]);
  assert.deepEqual(found.nothing, [...canopen, ...toCanopen]);
  assert.deepEqual(found.writable, [...canopen, ...ethercat, ...toEthercat]);
  assert.deepEqual(found.noValue, [...canopen, ...ethercat]);
  assert.match(found.unsigned, /^01 10 00 10 00 02 04 00 00 90 00 /);
  assert.match(found.signed, /^01 10 00 10 00 02 04 FF FF 90 00 /);
}

async function movesObjects(window) {
  const page = await window.go("aec-s-r-l/vector-step/no-revision/process-data.html");
  const builder = page.locator(".builder"), order = async () => (await builder.locator("li").allInnerTexts()).map((line) => line.slice(0, 6));
  await builder.getByText("Clear").click();
  for (const index of ["6040", "6060"]) {
    await builder.getByLabel("Object to map").fill(index);
    await page.keyboard.press("Enter");
  }
  for (const [direction, wanted] of [["down", ["0x6060", "0x6040"]], ["up", ["0x6040", "0x6060"]]]) {
    await builder.getByRole("button", { name: new RegExp(`^Move 0x6040.* ${direction}$`) }).click();
    assert.deepEqual(await order(), wanted);
  }
}

// Checks that the grid of the PDO builder has the rows of the page's own grid, and that COB-IDs are those of the chosen node.
async function showsBytes(window) {
  const page = await window.go("aec-s-r-l/vector-step/no-revision/process-data.html"), builder = page.locator(".builder");
  const rows = (table) => table.evaluate((grid) => [...grid.rows].map((row) => [...row.cells].map((cell) => cell.tagName === "TH" ? cell.textContent : cell.colSpan)));
  let count = 0;
  for (const section of await page.locator("section[data-cob-id]").all()) {
    const title = await section.locator("h2").innerText(), option = builder.locator("option").filter({ hasText: title.split(":")[0] });
    if (await option.count() !== 1 || await section.locator(".bytes").count() === 0) continue;
    await builder.getByLabel("PDO", { exact: true }).selectOption({ label: await option.innerText() });
    assert.deepEqual(await rows(builder.locator(".bytes")), await rows(section.locator(".bytes")), title);
    count += 1;
  }
  assert.ok(count >= 2, `only ${count} PDOs have a mapping`);
  const bits = await page.evaluate(() => byteGrid([[1, "a"], [2, "b"], [5, "c"], [12, "d_e"], [4, "f"]].map(([bits, name]) => ({ bits, name }))).map((row) => [...row.cells].map((cell) => cell.textContent + cell.colSpan)));
  assert.deepEqual(bits, [
    ["byte 0 bits 7–41", "c4"], ["byte 0 bits 3–01", "c1", "b2", "a1"], ["byte 11", "d_e1"], ["byte 2 bits 7–41", "f4"], ["byte 2 bits 3–01", "d_e4"],
  ]);
  await page.evaluate(() => document.querySelector(".builder select").selectedIndex = 0);
  for (const [node, cobId] of [["5", "0x205"], ["127", "0x27F"]]) {
    await builder.getByLabel("Node-ID").fill(node);
    await builder.getByLabel("PDO", { exact: true }).selectOption({ index: 0 });
    assert.match(await builder.locator("output").innerText(), new RegExp(`^COB-ID ${cobId}, `));
    assert.match(await page.locator("section[data-cob-id] .of-node").first().innerText(), new RegExp(`For node-ID ${node}: COB-ID ${cobId}`));
  }
}

// Checks the builder of a drive on EtherCAT: it clears the assignment, writes the mapping and assigns the PDO again (ETG.1000.6, 5.6.7.4).
async function mapsOnEthercat(window) {
  const page = await window.go("example/sv-1-servo-drive-0x00a10002/0x00020001/process-data.html"), builder = page.locator(".builder");
  assert.deepEqual(await builder.locator("select option").allInnerTexts(), ["RxPDO 0x1600", "RxPDO 0x1601"]);
  assert.ok(await builder.getByLabel("Node-ID").isHidden());
  await builder.getByText("Clear").click();
  for (const index of ["6040", "607A"]) {
    await builder.getByLabel("Object to map").fill(index);
    await page.keyboard.press("Enter");
  }
  assert.match(await builder.locator("output").innerText(), /^6 of \d+ bytes, 2 of 254 entries$/);
  const [sdos, python, rust] = await builder.locator("code").allInnerTexts();
  assert.deepEqual(sdos.split("\n"), [
    "2F 12 1C 00 00 00 00 00", "2F 00 16 00 00 00 00 00", "23 00 16 01 10 00 40 60", "23 00 16 02 20 00 7A 60", "2F 00 16 00 02 00 00 00",
    "2B 12 1C 01 00 16 00 00", "2F 12 1C 00 01 00 00 00",
  ]);
  assert.equal(python.split("\n")[2], 'slave.sdo_write(0x1600, 1, bytes.fromhex("10004060"))');
  assert.match(rust, /device::pdo::PositionMode \{ controlword, target_position \}/);
}

// Checks that a write of a value contains the whole record. The other values have their defaults, and numbers are big-endian.
async function writesRecords(window) {
  const cases = [["bytes_3_6", "10.0", "5A 01 84 41 20 00 00 EE 07"], ["byte_2_bits_3_1", "3", "5A 01 86 3F C0 00 00 EE 07"], ["byte_2_bit_7", "0", "5A 01 04 3F C0 00 00 EE 07"]];
  for (const [position, raw, expected] of cases) {
    const page = await window.go(`example/_files/safe-gsdml/modules.html#submodule-00000021.record_0x0002__${position}`);
    const row = page.locator(".items > tbody.open");
    await row.locator(".requests summary").click();
    const lines = row.locator(".requests dd code");
    await lines.first().waitFor();
    assert.equal(await lines.count(), 1, "a write without a value");
    await row.locator(".raw").fill(raw);
    const [read, write, bytes] = await lines.allInnerTexts();
    assert.match(read, /^API 0, slot of the module \(1 to 3\), subslot 1, index 0x0002, length 9, value in /);
    assert.equal(write, read);
    assert.equal(bytes, expected);
  }
}
