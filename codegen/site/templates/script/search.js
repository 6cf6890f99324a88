// The search.
// The index of a site or of one device: devices with their titles and further words, pages with their device and kind, numbers, texts
// and anchors. An entry refers to a page, a number and a text, and has an anchor; the entry of a whole page has no number. A text
// contains name, names in other languages, unit and description.
let pages = [], titles = [], numbers = [], texts = [], anchors = [], isLoading = false, isLoaded = false;
// For each entry, the positions of its page, number and text in these lists.
let pageAt, numberAt, textAt;

function lexibusIndex(devices, pageList, numberLines, textLines, anchorLines, entries) {
  pages = pageList.map(([path, device, kind]) => ({ path, device, kind, title: devices[device][0] }));
  titles = devices.map((words) => plain(words.join(" ")));
  numbers = linesOf(numberLines).map(([text, plain]) => ({ text, plain, isPart: PART.test(text), ranges: undefined }));
  texts = linesOf(textLines).map(([text, plain]) => ({ text, plain, name: plain.slice(0, plain.indexOf("\t")) }));
  anchors = anchorLines.split("\n");
  [pageAt, numberAt, textAt] = [0, 1, 2].map(() => new Uint32Array(anchors.length));
  let at = 0;
  for (const [page, pairs] of entries.entries()) {
    for (let next = 0; next < pairs.length; next += 2, at++) {
      pageAt[at] = page;
      numberAt[at] = pairs[next];
      textAt[at] = pairs[next + 1];
    }
  }
  isLoaded = true;
  lead();
  search();
}

// Returns each line with its plain text.
function linesOf(lines) {
  const plainLines = plain(lines).split("\n");
  return lines.split("\n").map((line, at) => [line, plainLines[at]]);
}

// Numbers of bits and values, which are parts of an item.
const PART = /^(bit|value) /;

// Returns the ranges of a number such as `0x6040:01`, `register 12–13 (wire 11–12)` or `0x6100 to 0x61FF`: printed, and on the wire.
function rangesOf(number) {
  if (number.ranges) return number.ranges;
  const patterns = number.isPart ? [] : number.plain.includes("(wire ") ? [PRINTED, WIRE] : [PRINTED];
  number.ranges = [];
  for (const pattern of patterns) {
    const range = pattern.exec(number.plain);
    if (range) number.ranges.push({ first: Number(range[1]), last: Number(range[2] ?? range[1]) });
  }
  return number.ranges;
}

const PRINTED = /^(?:[a-z_ ]+ )?(0x[0-9a-f]+|[0-9]+)(?:(?: to |–)(0x[0-9a-f]+|[0-9]+))?/;
const WIRE = /\(wire (0x[0-9a-f]+|[0-9]+)(?:–(0x[0-9a-f]+|[0-9]+))?\)/;

// The folder of the site, and the folder of the index.
const site = root.dataset.root + "/", folder = site + (root.dataset.index || "");
const input = byId("search"), found = byId("found");

function load() {
  if (isLoading) return;
  isLoading = true;
  const script = document.createElement("script");
  script.src = folder + "search.js";
  document.head.append(script);
}

// Returns the notations of a word: `6040h` and `6040` can mean `0x6040`, `2020:1` means `0x2020:01`.
function notations(word) {
  const [, index, sub] = word.match(/^(?:0x)?([0-9a-f]{4}|[0-9a-f]{1,4}(?=[h:]))h?(?::(?:0x)?([0-9a-f]{1,2})h?)?$/) ?? [];
  if (index === undefined) return [word];
  return [word, "0x" + index.padStart(4, "0") + (sub === undefined ? "" : ":" + sub.padStart(2, "0"))];
}

// Returns the numbers that a word can mean. A word of four hexadecimal digits can be an index without `0x`.
function values(word) {
  const all = /^(0x[0-9a-f]+|[0-9]+)$/.test(word) ? [Number(word)] : [];
  const [, digits] = word.match(/^([0-9a-f]{4}|[0-9a-f]{1,8}(?=h$))h?$/) ?? [];
  return digits === undefined ? all : [...all, parseInt(digits, 16)];
}

// Returns how well a number matches a word, in points. Returns 0 if the number does not contain the word.
function numberPoints(number, { word, notations, values }) {
  if (notations.includes(number.plain)) return 150;
  for (const { first, last } of values.length ? rangesOf(number) : []) {
    if (values.includes(first)) return number.plain.includes(":") ? 90 : 100;
    if (values.some((value) => first < value && value <= last)) return 60;
  }
  if (!number.plain.includes(word)) return 0;
  return word.length > 2 ? 20 : 1;
}

const isLetter = (letter) => letter !== undefined && (letter < "\x80" ? letter >= "a" && letter <= "z" || letter >= "0" && letter <= "9" : /[\p{L}\p{N}]/u.test(letter));
const isWhole = (text, at, length) => !isLetter(text[at - 1]) && !isLetter(text[at + length]);

// Returns the points of a text for a word. A whole unit counts more than a part of a name: `v` is part of most names.
function textPoints({ plain, name }, word) {
  if (!plain.includes(word)) return 0;
  const [, names, unit] = plain.split("\t");
  let points = 0;
  if (name === word) points += 100;
  if (name.startsWith(word)) points += 30;
  const at = name.indexOf(word);
  if (at >= 0) points += isWhole(name, at, word.length) ? 35 : 10;
  if (names.includes(word)) points += 8;
  if (unit === word) points += 50;
  return points || 1;
}

function each(list, points) {
  const all = new Uint16Array(list.length);
  for (let at = 0; at < list.length; at++) all[at] = points(list[at]);
  return all;
}

// Cache with the points of all numbers, texts and titles for each word. Previous words stay the same while the reader types the next one.
const known = new Map();

function pointsOf(word) {
  if (!known.has(word)) {
    if (known.size > 20) known.clear();
    const exact = pointsOfExact(word);
    const isFound = word.length < 4 || /^[0-9]/.test(word) || Object.values(exact).some((points) => points.some(Boolean));
    known.set(word, isFound ? exact : pointsOfSimilar(word) ?? exact);
  }
  return known.get(word);
}

function pointsOfExact(word) {
  const query = { word, notations: notations(word), values: values(word) };
  return {
    numbers: each(numbers, (number) => numberPoints(number, query)),
    texts: each(texts, (text) => textPoints(text, word)),
    titles: each(titles, (title) => Number(title.includes(word))),
  };
}

// Returns the points for the words of the index that differ from a word by one typing error. Returns nothing if there is none.
function pointsOfSimilar(word) {
  const all = similarWords(word).map(pointsOfExact);
  return all.length ? all.reduce((sum, points) => {
    for (const [list, values] of Object.entries(points)) values.forEach((value, at) => { sum[list][at] = Math.max(sum[list][at], value); });
    return sum;
  }) : undefined;
}

let vocabulary;
const MOST_SIMILAR = 5;

function similarWords(word) {
  vocabulary ??= new Set([...texts.map((text) => text.plain), ...titles].join(" ").match(/[\p{L}\p{N}]{3,}/gu));
  const similar = [];
  for (const known of vocabulary) {
    if (Math.abs(known.length - word.length) <= 1 && isSimilar(known, word) && similar.push(known) === MOST_SIMILAR) break;
  }
  return similar;
}

// Returns whether two different words differ by one letter: added, removed, replaced, or exchanged with the next one.
function isSimilar(one, other) {
  let start = 0;
  while (one[start] === other[start]) start++;
  const rest = (text, from) => text.slice(start + from);
  return rest(one, 1) === rest(other, 1) || rest(one, 1) === rest(other, 0) || rest(one, 0) === rest(other, 1)
    || one[start] === other[start + 1] && one[start + 1] === other[start] && rest(one, 2) === rest(other, 2);
}

// Maximum number of results.
const MOST = 50;

// Adds the points for a word to the sum of each entry. The sum becomes -1 if neither the entry nor its device has the word.
function add({ numbers, texts, titles }, sums) {
  for (let entry = 0; entry < sums.length; entry++) {
    const points = numbers[numberAt[entry]] + texts[textAt[entry]];
    sums[entry] = sums[entry] < 0 || points === 0 && titles[pages[pageAt[entry]].device] === 0 ? -1 : sums[entry] + points;
  }
}

// Returns the entries that match all words. The best entries come first: those whose name is the whole query, independent of their
// numbers, then by points; equal entries have the order of the index. Entries are left out if only their device matches.
function matches(query) {
  const wanted = plain(query).trim(), words = wanted.split(/\s+/).filter(Boolean), best = [];
  if (!words.length || !isLoaded) return best;
  const sums = new Int32Array(anchors.length), isWanted = each(texts, (text) => Number(text.name === wanted));
  for (const word of words) add(pointsOf(word), sums);
  for (let entry = 0, minimum = 0; entry < sums.length; entry++) {
    if (sums[entry] > 0 && isWanted[textAt[entry]]) sums[entry] = 300 + 200 * words.length;
    if (sums[entry] > minimum) minimum = insert(best, { points: sums[entry], entry });
  }
  // A row has one entry per address. Only the best entry of a row is shown.
  const links = new Set();
  return best.map(({ entry }) => entry).filter((entry) => !links.has(linkOf(entry)) && links.add(linkOf(entry))).slice(0, MOST);
}

// Inserts an entry into the sorted list. Returns the points that the next entry must exceed to be inserted.
function insert(best, match) {
  const position = best.findIndex((other) => other.points < match.points);
  best.splice(position < 0 ? best.length : position, 0, match);
  if (best.length > 4 * MOST) best.pop();
  return best.length === 4 * MOST ? best[best.length - 1].points : 0;
}

const isPart = (entry) => numbers[numberAt[entry]].isPart;
// Returns the item of a bit or value, which is the last item before it.
const ownerOf = (entry) => {
  while (entry > 0 && isPart(entry)) entry--;
  return entry;
};
const anchorOf = (entry) => {
  const own = anchors[entry] || numbers[numberAt[entry]].text;
  return isPart(entry) ? `${anchorOf(ownerOf(entry))}.${own.replace(" ", "-").replace(/ .*/, "")}` : own;
};
const linkOf = (entry) => {
  const anchor = anchorOf(entry);
  return site + pages[pageAt[entry]].path + (anchor && "#" + encodeURIComponent(anchor));
};

let selected = 0;
const announcement = document.createElement("p");
announcement.setAttribute("role", "status");
found.after(announcement);

function search() {
  const list = matches(input.value);
  found.replaceChildren(...list.map((entry, at) => {
    const [name, names, unit] = texts[textAt[entry]].text.split("\t"), page = pages[pageAt[entry]], number = numbers[numberAt[entry]].text;
    const owner = isPart(entry) ? [numbers[numberAt[ownerOf(entry)]].text, texts[textAt[ownerOf(entry)]].text.split("\t")[0]].join(" ") : "";
    const kind = number || page.kind === "device" ? page.kind : "page";
    const more = element("small", { textContent: [owner, kind, names, unit, page.title].filter(Boolean).join(" · ") });
    const link = element("a", { role: "option", id: "found-" + at, href: linkOf(entry), tabIndex: -1 }, `${number} ${name} `.trimStart(), more);
    return element("li", { role: "presentation" }, link);
  }));
  found.hidden = !list.length;
  input.setAttribute("aria-expanded", String(list.length > 0));
  announcement.textContent = list.length || !isLoaded || !input.value.trim() ? "" : "Nothing found.";
  select(0);
}

function select(at) {
  const items = found.querySelectorAll("a");
  selected = Math.max(0, Math.min(at, items.length - 1));
  for (const [position, item] of [...items].entries()) item.setAttribute("aria-selected", String(position === selected));
  if (items[selected]) {
    input.setAttribute("aria-activedescendant", items[selected].id);
    items[selected].scrollIntoView({ block: "nearest" });
  } else {
    input.removeAttribute("aria-activedescendant");
  }
}

function close() {
  found.hidden = true;
  announcement.textContent = "";
  input.setAttribute("aria-expanded", "false");
}

input.addEventListener("focus", load);
input.addEventListener("input", search);
input.addEventListener("keydown", (event) => {
  if (event.key === "ArrowDown") select(selected + 1);
  else if (event.key === "ArrowUp") select(selected - 1);
  else if (event.key === "Escape") { close(); input.blur(); }
  else if (event.key === "Enter") {
    const link = found.querySelectorAll("a")[selected];
    if (link) { close(); location.href = link.href; }
  } else return;
  event.preventDefault();
});
found.addEventListener("click", close);
for (const leaving of ["focusin", "pointerdown"]) {
  document.addEventListener(leaving, ({ target }) => { if (!target.closest(".search")) close(); });
}
document.addEventListener("keydown", (event) => {
  const isShortcut = event.key === "/" ? !/INPUT|SELECT|TEXTAREA/.test(document.activeElement.tagName) : event.key === "k" && (event.ctrlKey || event.metaKey);
  if (!isShortcut) return;
  event.preventDefault();
  input.focus();
  input.select();
});

// Returns the address of the item that has a bit or value: `0x6041` of `0x6041.bit-3`.
const withoutPart = (address) => address.replace(/\.(bit|value)-[^.]+$/, "");

// Returns the address in the URL if this page does not have it.
function missingAddress() {
  const address = addressOfUrl();
  return byId(address) || byId(withoutPart(address)) ? "" : plain(address);
}

// Opens the page that contains the address. If an entry has no separate row, opens the row of its object.
function lead() {
  const address = missingAddress();
  for (const candidate of address ? [address, withoutPart(address), address.split(":")[0]] : []) {
    const entry = anchors.findIndex((_, entry) => plain(anchorOf(entry)) === candidate);
    if (entry < 0) continue;
    location.replace(linkOf(entry));
    return;
  }
}

function leadOrLoad() {
  if (isLoaded) lead();
  else if (missingAddress()) load();
}
addEventListener("hashchange", leadOrLoad);
