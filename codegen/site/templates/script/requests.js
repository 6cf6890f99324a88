// Requests that read and write the item of a row, ready to copy: bytes on each bus, and lines of Python.

const bytesText = (bytes) => bytes.map((byte) => hex(byte, 2)).join(" ");

// Returns the bytes of a raw value, least significant byte first.
function littleEndian(raw, count) {
  return Array.from({ length: count }, (_, at) => Number(raw >> BigInt(8 * at) & 0xFFn));
}

// CRC of a Modbus RTU frame (MODBUS over Serial Line V1.02, 6.2.2).
function withCrc(bytes) {
  let crc = 0xFFFF;
  for (const byte of bytes) {
    crc ^= byte;
    for (let bit = 0; bit < 8; bit++) crc = crc & 1 ? crc >> 1 ^ 0xA001 : crc >> 1;
  }
  return [...bytes, crc & 0xFF, crc >> 8];
}

const python = (bytes) => `bytes.fromhex("${bytes.map((byte) => hex(byte, 2)).join("")}")`;

// Returns the frames of an SDO download (CiA 301, 7.2.4.3.3): an expedited transfer, or a segmented one if there are more than four bytes.
function sdoDownload(head, bytes) {
  if (bytes.length <= 4) return [[0x23 | 4 - bytes.length << 2, ...head, ...bytes, 0, 0, 0, 0].slice(0, 8)];
  const frames = [[0x21, ...head, bytes.length, 0, 0, 0]];
  for (let at = 0; at < bytes.length; at += 7) {
    const part = bytes.slice(at, at + 7), isLast = at + 7 >= bytes.length;
    frames.push([at / 7 % 2 << 4 | 7 - part.length << 1 | Number(isLast), ...part, 0, 0, 0, 0, 0, 0, 0].slice(0, 8));
  }
  return frames;
}

// Returns whether an object can be read and written on a bus. `buses` has the access rights of a bus after its letter, if they differ from
// those of the row.
function rightsOn(bus, buses, { canRead, canWrite, hasValue }) {
  const [is, rights] = new RegExp(`${bus}([rw-]*)`).exec(buses) ?? [];
  if (!is) return {};
  return rights ? { canRead: rights.includes("r"), canWrite: rights.includes("w") && hasValue } : { canRead, canWrite };
}

// Requests of an object: SDOs on CANopen, and the same services on EtherCAT.
function objectRequests([index, sub, buses], row) {
  const { bytes, node } = row, canopen = rightsOn("c", buses, row), ethercat = rightsOn("e", buses, row);
  const [number, entry] = [Number(index), Number(sub)], head = [number & 0xFF, number >> 8, entry];
  const path = `0x${hex(number, 4)}, ${entry}`, lines = [];
  const cobId = hex(0x600 + node, 3), frame = (data) => `${cobId}  ${bytesText(data)}`;
  if (canopen.canRead) lines.push(["SDO upload (COB-ID, data)", frame([0x40, ...head, 0, 0, 0, 0])], ["canopen read", `node.sdo.upload(${path})`]);
  if (canopen.canWrite) lines.push(["SDO download (COB-ID, data)", sdoDownload(head, bytes).map(frame).join("\n")], ["canopen write", `node.sdo.download(${path}, ${python(bytes)})`]);
  if (ethercat.canRead) lines.push(["pysoem read", `slave.sdo_read(${path})`]);
  if (ethercat.canWrite) lines.push(["pysoem write", `slave.sdo_write(${path}, ${python(bytes)})`]);
  return lines;
}

const READS = { h: [3, "read_holding_registers"], i: [4, "read_input_registers"], c: [1, "read_coils"], d: [2, "read_discrete_inputs"] };

// Requests of Modbus registers, coils and discrete inputs (MODBUS Application Protocol V1.1b3, 6).
function modbusRequests([table, address, count, flags, functions], { canRead, canWrite, bytes, unit, raw }) {
  const [start, words] = [Number(address), Number(count)], head = [start >> 8, start & 0xFF], size = [words >> 8, words & 0xFF];
  const accepted = functions.split("/").map(Number), [read, method] = READS[table], lines = [];
  const rtu = (data) => bytesText(withCrc([unit, ...data]));
  if (canRead && accepted.includes(read)) {
    lines.push(["Modbus RTU read", rtu([read, ...head, ...size])], ["pymodbus read", `client.${method}(${start}, count=${words}, device_id=${unit})`]);
  }
  const isBit = table === "c", isPart = flags.includes("p");
  if (isBit && canWrite && accepted.includes(5)) {
    lines.push(["Modbus RTU write", rtu([5, ...head, raw ? 0xFF : 0, 0])], ["pymodbus write", `client.write_coil(${start}, ${raw ? "True" : "False"}, device_id=${unit})`]);
  }
  if (isBit || isPart || !canWrite) return lines;
  const fill = flags.includes("x") && bytes.at(-1) & 0x80 ? 0xFF : 0;
  const low = Array.from({ length: words }, (_, at) => (bytes[2 * at + 1] ?? fill) << 8 | (bytes[2 * at] ?? fill));
  const ordered = (flags.includes("l") ? low : low.reverse()).map((word) => flags.includes("s") ? (word & 0xFF) << 8 | word >> 8 : word);
  const data = ordered.flatMap((word) => [word >> 8, word & 0xFF]), list = ordered.map((word) => `0x${hex(word, 4)}`);
  if (words === 1 && accepted.includes(6)) {
    lines.push(["Modbus RTU write", rtu([6, ...head, ...data])], ["pymodbus write", `client.write_register(${start}, ${list[0]}, device_id=${unit})`]);
  } else if (accepted.includes(16)) {
    lines.push(["Modbus RTU write", rtu([16, ...head, ...size, data.length, ...data])], ["pymodbus write", `client.write_registers(${start}, [${list.join(", ")}], device_id=${unit})`]);
  }
  return lines;
}

// Returns the bytes of a record with a raw value at its position. The bytes of a number are in the order from high to low.
function recordBytes(bytes, offset, bits, raw) {
  const changed = [...bytes], last = Math.floor((offset + bits - 1) / 8);
  for (let bit = 0; bit < bits; bit++) {
    const at = offset % 8 + bit, mask = 1 << at % 8, byte = last - Math.floor(at / 8);
    changed[byte] = raw >> BigInt(bit) & 1n ? changed[byte] | mask : changed[byte] & ~mask;
  }
  return changed;
}

// A record is read and written as a whole. The other values have their default.
function recordRequests([offset, bits, ...address], { canRead, canWrite, raw, record }) {
  const text = address.join(" "), lines = canRead ? [["PROFINET record read", text]] : [];
  if (canWrite) lines.push(["PROFINET record write", text]);
  if (canWrite && record) lines.push(["PROFINET record bytes", bytesText(recordBytes(record, Number(offset), Number(bits), raw))]);
  return lines;
}

// Returns the default bytes of the record with a row, which the page shows before the table.
function recordOf(row) {
  const text = row.closest("table").previousElementSibling?.querySelector(":scope > code")?.textContent;
  return text?.split(" ").map((byte) => parseInt(byte, 16));
}

const KINDS = { o: objectRequests, m: modbusRequests, r: recordRequests };

// Creates a field for a number that the reader chooses once for all pages.
function keptNumber(key, label, first, last, change) {
  const input = element("input", { type: "number", min: first, max: last, required: true, value: kept(key) || first, className: "number" });
  input.addEventListener("input", () => { if (input.reportValidity()) { kept(key, input.value); change(); } });
  return { label: element("label", {}, `${label} `, input), get value() { return Number(input.value); } };
}

// Returns a term and a definition that can be copied.
function copyable([title, text]) {
  const code = element("code", { textContent: text });
  return [element("dt", { textContent: title }), element("dd", {}, code, " ", copyButton(code))];
}

// Adds the requests to the details of a row. Returns a function that shows the requests for a raw value.
function requests(row, type) {
  const addresses = (row.dataset.at ?? "").split(";").filter(Boolean).map((address) => address.split(" "));
  const access = row.rows[0].cells[3].textContent, list = element("dl", {});
  const record = addresses.some(([kind]) => kind === "r") ? recordOf(row) : undefined;
  const canRead = !/^wo/.test(access), isWritable = /^[rw]*w/.test(access) && Boolean(type);
  // Without a value there are no write requests, because a copied request would write 0.
  let raw;
  const show = () => {
    hint.textContent = isWritable && raw === undefined ? "Enter a raw value within the range for write requests." : "";
    const hasValue = Boolean(type) && raw !== undefined, canWrite = isWritable && hasValue, bytes = hasValue ? littleEndian(raw, Math.ceil(type.bits / 8)) : [];
    const lines = addresses.flatMap(([kind, ...address]) => KINDS[kind](address, { canRead, canWrite, hasValue, bytes, raw, record, node: node.value, unit: unit.value }));
    list.replaceChildren(...lines.flatMap(copyable));
  };
  const node = keptNumber("node", "Node-ID", 1, 127, () => show()), unit = keptNumber("unit", "Modbus unit", 1, 247, () => show());
  if (!addresses.length) return () => {};
  const has = (kind, text = "") => addresses.some((address) => address[0] === kind && address.join(" ").includes(text));
  const choices = [has("o", "c") && node.label, has("m") && unit.label].filter(Boolean);
  const hint = element("span", {});
  const details = element("details", { className: "tools requests" }, element("summary", { textContent: "Requests" }), element("p", {}, ...choices, hint), list);
  details.addEventListener("toggle", show);
  row.querySelector(":scope > .more > td").append(details);
  return (value) => {
    raw = value;
    if (details.open) show();
  };
}
