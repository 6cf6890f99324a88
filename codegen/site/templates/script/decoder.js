// The decoder of a row. A raw value, its physical value and its bit fields determine each other.

// Copies the bits and values of a row with the same type into a row that only refers to them.
completions.push((row) => {
  const reference = row.querySelector(".same");
  const source = reference && byId(decodeURIComponent(reference.querySelector("a").hash.slice(1)));
  if (!source) return;
  const parts = source.querySelectorAll(":scope > .more > td > :is(.wide, .fields, dl)");
  reference.after(...[...parts].map((part) => part.cloneNode(true)));
  for (const part of row.querySelectorAll(".more [id]")) part.id = row.id + part.id.slice(source.id.length);
  for (const added of row.querySelectorAll("[data-control]")) added.remove();
});

// Creates the control of a bit field. Returns a function that shows the value of the field, and calls `change` with new values.
function fieldControl(line, field, change) {
  const name = line.cells[1].textContent.trim() || `bits ${line.cells[0].textContent}`;
  const cell = line.insertCell(1);
  cell.dataset.control = "";
  if (line.matches(".reserved")) return (value) => { cell.textContent = String(value); };
  // A field with a condition can have another meaning, depending on another item.
  const on = line.matches(".conditional") ? "maybe" : "on";
  if (field.bits === 1 && !field.labels.length) {
    const box = element("input", { type: "checkbox", ariaLabel: name }), bit = element("span", {});
    box.addEventListener("change", () => change(box.checked ? 1n : 0n));
    cell.append(box, bit);
    return (value) => {
      box.checked = value === 1n;
      bit.textContent = value === undefined ? "" : String(value);
      line.classList.toggle(on, value !== undefined && box.checked !== line.matches(".inverted"));
    };
  }
  const type = { bits: field.bits };
  const number = element("input", { type: "text", className: "number", ariaLabel: name, inputMode: "numeric" });
  number.addEventListener("input", () => {
    const value = rawFrom(number.value, type);
    number.setAttribute("aria-invalid", String(value === undefined));
    if (value !== undefined) change(value);
  });
  cell.append(number);
  return (value) => {
    if (document.activeElement !== number) number.value = value === undefined ? "" : String(value);
    line.classList.toggle(on, value !== undefined && value !== 0n);
    mark(field.labels, value);
  };
}

// Highlights the named value; none if there is no number. Returns its name.
function mark(labels, number) {
  const found = number === undefined ? undefined : labels.find(({ first, last }) => first <= number && number <= last);
  for (const label of labels) {
    label.term.classList.toggle("on", label === found);
    label.term.nextElementSibling.classList.toggle("on", label === found);
  }
  return found?.text;
}

// Returns the position of a bit field: the first bit and the number of bits.
function fieldOf(line) {
  const [last, first] = line.cells[0].textContent.split("–").map(Number);
  return { first: BigInt(first ?? last), bits: first === undefined ? 1 : last - first + 1, labels: labelsOf(line.querySelector("dl")) };
}

// Calls `changed` with the raw value of the decoder whenever it changes; without a value if it is invalid or out of range.
function decoder(row, type, changed) {
  const scale = scaleOf(row), unit = row.rows[0].cells[6].textContent, name = row.rows[0].cells[1].querySelector("b").textContent;
  const raw = element("input", { type: "text", className: "raw", placeholder: "0x… or decimal", ariaLabel: `Raw value of ${name}` });
  const physical = element("input", { type: "text", className: "physical", placeholder: unit || "value", ariaLabel: `Physical value of ${name}` });
  const shown = element("output", {});
  const labels = type.isReal ? [] : labelsOf(row.querySelector(":scope > .more > td > dl"));
  const fields = [...row.querySelectorAll(":scope > .more > td > .fields > tbody > tr")].map((line) => {
    const field = fieldOf(line), mask = ((1n << BigInt(field.bits)) - 1n) << field.first;
    const show = fieldControl(line, field, (value) => set(current & ~mask | value << field.first));
    return (all) => show(all === undefined ? undefined : (all & mask) >> field.first);
  });
  let current = 0n;
  const set = (value, source) => {
    const number = value === undefined ? undefined : numberOf(type, value), isAllowed = value !== undefined && isInRange(row, number);
    for (const field of [raw, physical]) field.setAttribute("aria-invalid", String(!isAllowed && field === source && field.value !== ""));
    if (value === undefined) {
      for (const field of [raw, physical]) if (field !== source) field.value = "";
      shown.textContent = source.value === "" ? "" : `not a number of the type ${row.rows[0].cells[2].textContent}`;
      mark(labels, undefined);
      for (const field of fields) field(undefined);
      changed(undefined);
      return;
    }
    current = value;
    if (source !== raw) raw.value = type.isReal || scale ? String(number) : hexOf(type, value);
    if (scale && source !== physical) physical.value = shortNumber(scale.physical(Number(number)));
    const label = type.isReal ? "" : mark(labels, number);
    const name = labels.length && !label ? "no named value" : label;
    shown.textContent = [String(number), hexOf(type, value), name].filter(Boolean).join(" = ") + (isAllowed ? "" : ": outside of the range");
    for (const field of fields) field(value);
    changed(isAllowed ? value : undefined);
  };
  raw.addEventListener("input", () => set(rawFrom(raw.value, type), raw));
  physical.addEventListener("input", () => set(rawOfPhysical(scale, type, physical.value), physical));
  const parts = [element("label", {}, "Raw value ", raw)];
  if (scale) parts.push(element("label", {}, "Physical value ", physical, unit && ` ${unit}`));
  row.querySelector(":scope > .more > td").prepend(element("p", { className: "tools decoder" }, ...parts, shown));
}

completions.push((row) => {
  const type = typeOf(row);
  const update = requests(row, type);
  if (type) decoder(row, type, update);
});
