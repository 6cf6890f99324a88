// The PDO builder: the reader chooses objects, and copies the SDOs that write the mapping (CiA 301, 7.5.2.36; ETG.1000.6, 5.6.7.4).

// Returns the SDO downloads that map objects into a PDO: index, sub-index and bytes of each. On CANopen, the PDO is disabled meanwhile. On
// EtherCAT, no PDO is assigned to the sync manager meanwhile.
function mappingWrites(pdo, objects, node) {
  const mapped = objects.map(([index, sub, bits], at) => [pdo.mapping, at + 1, littleEndian(BigInt(index) << 16n | BigInt(sub) << 8n | BigInt(bits), 4)]);
  const mapping = [[pdo.mapping, 0, [0]], ...mapped, [pdo.mapping, 0, [objects.length]]];
  if (pdo.bus === "e") {
    const [index, pdos] = pdo.assignment ?? [], assigned = (pdos ?? []).map((number, at) => [index, at + 1, littleEndian(BigInt(number), 2)]);
    return pdo.assignment ? [[index, 0, [0]], ...mapping, ...assigned, [index, 0, [pdos.length]]] : mapping;
  }
  const cobId = BigInt(pdo.cobId) + (pdo.ofNode ? BigInt(node) : 0n), disabled = 1n << 31n;
  const communication = (value) => pdo.communication ? [[pdo.communication, 1, littleEndian(value, 4)]] : [];
  return [...communication(cobId | disabled), ...mapping, ...communication(cobId & ~disabled)];
}

const isEntry = ([index, sub]) => (object) => object[0] === index && object[1] === sub;

// Returns why a mapping is invalid; an empty text if it is valid.
function mappingProblem(pdo, objects) {
  const bits = objects.reduce((sum, object) => sum + object[2], 0);
  const uneven = objects.find((object) => object[2] % pdo.granularity), lost = pdo.kept.find((entry) => !objects.some(isEntry(entry)));
  if (objects.length > pdo.entries) return `${objects.length} objects, but the mapping object has ${pdo.entries} entries`;
  if (bits > pdo.maxBits) return `${bits} bits, but the PDO has at most ${pdo.maxBits}`;
  if (lost) return `0x${hex(lost[0], 4)}:${hex(lost[1], 2)} must stay in the mapping`;
  return uneven ? `${uneven[3]} has ${uneven[2]} bits, which is not a multiple of ${pdo.granularity}` : "";
}

// Returns a gap: an entry without an object.
const gap = (bits) => [0, 0, bits, "gap", true, true, `_: ${bits}`, "ce"];

// Returns the lines that the reader can copy: the SDO downloads as bytes and in Python, and the mapping in Rust.
function mappingLines(pdo, objects, node) {
  const writes = mappingWrites(pdo, objects, node), isEthercat = pdo.bus === "e", cobId = isEthercat ? "" : `${hex(0x600 + node, 3)}  `;
  const sdos = writes.flatMap(([index, sub, bytes]) => sdoDownload([index & 0xFF, index >> 8, sub], bytes).map((data) => cobId + bytesText(data)));
  const method = isEthercat ? "slave.sdo_write" : "node.sdo.download";
  const lines = writes.map(([index, sub, bytes]) => `${method}(0x${hex(index, 4)}, ${sub}, ${python(bytes)})`);
  const rust = `lexibus::pdo! {\n    pub struct Mapping: device::pdo::${pdo.name} { ${objects.map((object) => object[6]).join(", ")} }\n}`;
  return [
    [`SDO downloads (${isEthercat ? "data" : "COB-ID, data"})`, sdos.join("\n")], [isEthercat ? "pysoem" : "canopen", lines.join("\n")],
    ...pdo.name ? [["Rust", rust]] : [],
  ];
}

// Returns the CAN identifier of a COB-ID for a node: the COB-ID without its flags.
const identifier = (cobId, node) => "0x" + hex(BigInt(cobId) + BigInt(node) & 0x1FFFFFFFn, 3);

// Shows the identifier of each PDO for a node.
function showCobIds(node) {
  for (const section of document.querySelectorAll("section[data-cob-id]")) {
    const shown = section.querySelector(".of-node") ?? section.querySelector(".run").appendChild(element("p", { className: "of-node" }));
    shown.textContent = `For node-ID ${node}: COB-ID ${identifier(section.dataset.cobId, node)}.`;
  }
}

// Returns the byte grid of consecutive fields, with the same rows as the grids of the page: up to four bytes, or four bits of a byte
// that several fields share. A field has a number of bits and a name.
function byteGrid(fields) {
  const owners = fields.flatMap(({ bits }, at) => Array(bits).fill(at)), rows = [];
  const isSplit = (start) => owners[start] !== owners[start + 7];
  const cells = (low, high, unit) => [...new Set(owners.slice(low, high))].map((at) => {
    const parts = fields[at].name.split(/(?<=_)/).flatMap((part) => [part, element("wbr", {})]);
    return element("td", { colSpan: owners.slice(low, high).filter((owner) => owner === at).length / unit }, ...parts.slice(0, -1));
  });
  const add = (position, list) => rows.push(element("tr", {}, element("th", { scope: "row", textContent: position }), ...list));
  const addBits = (low, high) => {
    const [byte, first, last] = [low >> 3, low % 8, (high - 1) % 8];
    if (low < high) add(first === last ? `byte ${byte} bit ${first}` : `byte ${byte} bits ${last}–${first}`, cells(low, high, 1).reverse());
  };
  for (let start = 0, end; start < owners.length; start = end) {
    end = start + 8;
    if (isSplit(start)) {
      const last = Math.min(end, owners.length), middle = Math.min(start + 4, last);
      addBits(middle, last);
      addBits(start, middle);
    } else {
      while (end % 32 && end < owners.length && !isSplit(end)) end += 8;
      add(end - start === 8 ? `byte ${start / 8}` : `bytes ${start / 8}–${end / 8 - 1}`, cells(start, end, 8));
    }
  }
  return rows;
}

function pdoBuilder(place) {
  const data = JSON.parse(place.content.textContent), mapped = new Map(data.objects.map((object) => [`${object[0]}:${object[1]}`, object]));
  const choice = element("select", { ariaLabel: "PDO" }, ...data.pdos.map((pdo, at) => element("option", { value: at, textContent: pdo.title })));
  const adding = element("input", { type: "text", className: "raw", placeholder: "Index or name", ariaLabel: "Object to map" });
  const options = element("datalist", { id: "mappable-objects" }), list = element("ol", { className: "mapping" });
  adding.setAttribute("list", options.id);
  const shown = element("output", {}), results = element("dl", {}), bytes = element("tbody", {});
  let objects = [];
  const pdo = () => data.pdos[Number(choice.value)];
  const candidates = () => data.objects.filter((object) => object[7].includes(pdo().bus) && (pdo().tx ? object[5] : object[4]));
  const button = (text, label, act) => {
    const created = element("button", { type: "button", textContent: text });
    if (label) created.setAttribute("aria-label", label);
    created.addEventListener("click", () => { act(); show(); });
    return created;
  };
  const exchange = (at) => { if (at >= 0 && at + 1 < objects.length) objects.splice(at, 2, objects[at + 1], objects[at]); };
  const line = (object, at) => element("li", {}, `${object[3]} (${object[2]} bits) `,
    button("↑", `Move ${object[3]} up`, () => exchange(at - 1)), button("↓", `Move ${object[3]} down`, () => exchange(at)),
    button("×", `Remove ${object[3]}`, () => objects.splice(at, 1)));
  const show = () => {
    list.replaceChildren(...objects.map(line));
    options.replaceChildren(...candidates().map((object) => element("option", { value: object[3] })));
    const problem = mappingProblem(pdo(), objects), bits = objects.reduce((sum, object) => sum + object[2], 0);
    const { bus, cobId, ofNode, maxBits, entries } = pdo(), isCanopen = bus === "c";
    const length = `${bits / 8} of ${maxBits / 8} bytes, ${objects.length} of ${entries} entries`;
    shown.textContent = problem || (isCanopen ? `COB-ID ${identifier(cobId, ofNode ? node.value : 0)}, ` : "") + length;
    node.label.hidden = !isCanopen;
    bytes.replaceChildren(...byteGrid(objects.map((object) => ({ bits: object[2], name: object[3] }))));
    showCobIds(node.value);
    shown.classList.toggle("wrong", problem !== "");
    results.replaceChildren(...problem || !objects.length ? [] : mappingLines(pdo(), objects, node.value).flatMap(copyable));
  };
  const node = keptNumber("node", "Node-ID", 1, 127, show);
  const start = () => {
    objects = pdo().mapped.map(([index, sub, bits]) => !index && pdo().bus === "e" ? gap(bits) : mapped.get(`${index}:${sub}`)).filter(Boolean);
    show();
  };
  choice.addEventListener("change", start);
  // An object is added when its name is chosen from the list, or by Enter for the first one that contains the typed text.
  const add = (object) => {
    if (!object) return;
    objects.push(object);
    adding.value = "";
    show();
  };
  adding.addEventListener("input", () => add(candidates().find((object) => object[3] === adding.value)));
  adding.addEventListener("keydown", (event) => {
    if (event.key !== "Enter" || !adding.value.trim()) return;
    event.preventDefault();
    const typed = plain(adding.value.trim());
    add(candidates().find((object) => plain(object[3]).includes(typed)));
  });
  place.replaceWith(element("div", { className: "tools builder" },
    element("p", { textContent: "The PDO builder shows the SDO downloads that map the objects of a list into a PDO." }),
    element("p", {}, element("label", {}, "PDO ", choice), node.label, button("Clear", "", () => { objects = []; })),
    list, element("p", {}, element("label", {}, "Map ", adding), shown), options,
    element("table", { className: "bytes", ariaLabel: "Bytes of the mapping" }, bytes), results));
  start();
}

if (byId("mappable")) {
  pdoBuilder(byId("mappable"));
} else if (document.querySelector("section[data-cob-id]")) {
  // PDOs whose mapping cannot be changed.
  const node = keptNumber("node", "Node-ID", 1, 127, () => showCobIds(node.value));
  document.querySelector("h1").after(element("p", { className: "tools" }, node.label));
  showCobIds(node.value);
}
