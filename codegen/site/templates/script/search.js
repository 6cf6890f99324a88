// The search.

// Numbers of bits and values, which are parts of an item.
const PART = /^(bit|value) /;

// Returns the ranges of a number such as `0x6040:01`, `register 12–13 (wire 11–12)` or `0x6100 to 0x61FF`, printed and on the wire:
// first and last number of each.
function rangesOf(number) {
  number.ranges ??= number.isPart ? [] : OBJECT.test(number.plain) ? objectRange(parseInt(number.plain, 16)) : [PRINTED, WIRE].flatMap((pattern) => {
    const range = pattern.exec(number.plain);
    return range ? [Number(range[1]), Number(range[2] ?? range[1])] : [];
  });
  return number.ranges;
}

const objectRange = (index) => [index, index];
const OBJECT = /^0x[0-9a-f]+(:[0-9a-f]+)?$/;
const PRINTED = /^(?:[a-z_ ]+ )?(0x[0-9a-f]+|[0-9]+)(?:(?: to |–)(0x[0-9a-f]+|[0-9]+))?/;
const WIRE = /\(wire (0x[0-9a-f]+|[0-9]+)(?:–(0x[0-9a-f]+|[0-9]+))?\)/;

const input = byId("search"), found = byId("found");

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
  const points = values.length && rangePoints(number, values);
  if (points) return points;
  if (!number.plain.includes(word)) return 0;
  return word.length > 2 ? 20 : 1;
}

// Returns the points for the first range that contains one of the values.
function rangePoints(number, values) {
  const ranges = rangesOf(number);
  for (let at = 0; at < ranges.length; at += 2) {
    for (const value of values) if (value === ranges[at]) return number.plain.includes(":") ? 90 : 100;
    for (const value of values) if (ranges[at] < value && value <= ranges[at + 1]) return 60;
  }
  return 0;
}

const isLetter = (letter) => letter !== undefined && (letter < "\x80" ? letter >= "a" && letter <= "z" || letter >= "0" && letter <= "9" : /[\p{L}\p{N}]/u.test(letter));
const isWhole = (text, at, length) => !isLetter(text[at - 1]) && !isLetter(text[at + length]);

// Returns the points of a text for a word. A whole unit counts more than a part of a name: `v` is part of most names.
function textPoints(text, word) {
  const { plain, nameEnd } = text, at = plain.indexOf(word);
  if (at < 0) return 0;
  const namesEnd = plain.indexOf("\t", nameEnd + 1), inNames = plain.indexOf(word, nameEnd + 1);
  let points = 0;
  if (at === 0) points += 30;
  if (at + word.length <= nameEnd) points += isWhole(plain, at, word.length) ? 35 : 10;
  if (isName(text, word)) points += 100;
  if (inNames >= 0 && inNames < namesEnd) points += 8;
  if (plain.startsWith(word + "\t", namesEnd + 1)) points += 50;
  return points || 1;
}

const isName = ({ plain, nameEnd }, word) => nameEnd === word.length && plain.startsWith(word);

function each(list, points) {
  const all = new Uint16Array(list.length);
  for (let at = 0; at < list.length; at++) all[at] = points(list[at], at);
  return all;
}

// Whether the search uses its last index. The first part of the index can lack the best result.
const isComplete = () => isLoaded || isMissing;

// Cache with the points of all entries and titles for each word. Previous words stay the same while the reader types the next one.
const known = new Map();

function pointsOf(word) {
  if (!known.has(word)) {
    if (known.size > 20) known.clear();
    const exact = pointsOfExact(word);
    // A word that the first part lacks is usually no typing error.
    const isFound = !isComplete() || word.length < 4 || /^[0-9]/.test(word) || Object.values(exact).some((points) => points.some(Boolean));
    known.set(word, isFound ? exact : pointsOfSimilar(word) ?? exact);
  }
  return known.get(word);
}

// Returns the points of all entries, and 1 for each device whose title or further words contain the word.
function pointsOfExact(word) {
  const query = { word, notations: notations(word), values: values(word) };
  const ofNumbers = each(numbers, (number) => numberPoints(number, query)), ofTexts = each(texts, (text) => textPoints(text, word));
  return {
    entries: each(numberAt, (number, entry) => ofNumbers[number] + ofTexts[textAt[entry]]),
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

// Returns the places that match all words. The best places come first: those whose name is the whole query, independent of their
// numbers, then by points; equal places have the order of the index. Places are left out if only their device matches.
function matches(query) {
  const wanted = plain(query).trim(), words = wanted.split(/\s+/).filter(Boolean).slice(0, MOST_WORDS), best = [];
  if (!words.length || !pages.length) return best;
  const points = words.map(pointsOf), sums = sumsOf(points, wanted), isWithout = lacks(points.map(({ entries }) => entries));
  // For each device, the words that it does not have, as bits.
  const lacking = lacks(points.map(({ titles }) => titles));
  for (let place = 0, minimum = 0; place < entryAt.length; place++) {
    const entry = entryAt[place];
    if (sums[entry] <= minimum || isWithout[entry] & lacking[pages[pageAt[place]].device]) continue;
    minimum = insert(best, { points: sums[entry], place });
  }
  // A row has one place per address. Only the best place of a row is shown.
  const links = new Set();
  return best.map(({ place }) => place).filter((place) => !links.has(linkOf(place)) && links.add(linkOf(place))).slice(0, MOST);
}

// Maximum number of words, one per bit of a number.
const MOST_WORDS = 31;

// Returns the sum of each entry's points for all words.
function sumsOf(points, wanted) {
  const sums = new Int32Array(numberAt.length), isWanted = each(texts, (text) => Number(isName(text, wanted)));
  for (const { entries } of points) for (let entry = 0; entry < sums.length; entry++) sums[entry] += entries[entry];
  for (let entry = 0; entry < sums.length; entry++) {
    if (sums[entry] > 0 && isWanted[textAt[entry]]) sums[entry] = 300 + 200 * points.length;
  }
  return sums;
}

// Returns the words for which each element of the lists has no points, as bits.
function lacks(lists) {
  const bits = new Int32Array(lists[0].length);
  for (const [word, list] of lists.entries()) for (let at = 0; at < bits.length; at++) if (!list[at]) bits[at] |= 1 << word;
  return bits;
}

// Returns links to the devices whose titles or further words contain all words.
function devicesWith(words) {
  const isFound = titles.map((title) => words.length > 0 && words.every((word) => title.includes(word)));
  const first = pages.filter(({ kind, device }) => kind === "device" && isFound[device]);
  return first.map(({ path, title }) => element("a", { href: site + path, textContent: title }));
}

// Inserts a place into the sorted list. Returns the points that the next place must exceed to be inserted.
function insert(best, match) {
  const position = best.findIndex((other) => other.points < match.points);
  best.splice(position < 0 ? best.length : position, 0, match);
  if (best.length > 4 * MOST) best.pop();
  return best.length === 4 * MOST ? best[best.length - 1].points : 0;
}

const printedAt = (place) => numbers[numberAt[entryAt[place]]];
// Returns name, names in other languages, unit and description.
const textsOf = (place) => texts[textAt[entryAt[place]]].text.split("\t");
// Returns the item of a bit or value, which is the last item before it.
const ownerOf = (place) => {
  while (place > 0 && printedAt(place).isPart) place--;
  return place;
};
const anchorOf = (place) => {
  const { text, isPart } = printedAt(place), anchor = anchors[anchorAt[entryAt[place]]] || text;
  // The anchor of a part is derived from its number: `bit-3-0` for `bit 3–0`, `value-3` for `value 3 to 5`.
  return isPart ? `${anchorOf(ownerOf(place))}.${anchor.replace(" ", "-").replace(/ .*/, "").replace("–", "-")}` : anchor;
};
const linkOf = (place) => {
  const anchor = anchorOf(place);
  return site + pages[pageAt[place]].path + (anchor && "#" + encodeURIComponent(anchor));
};

let selected = 0;
const announcement = document.createElement("p");
announcement.setAttribute("role", "status");
found.after(announcement);

function search() {
  const list = matches(input.value);
  found.replaceChildren(...list.map((place, at) => {
    const [name, names, unit] = textsOf(place), page = pages[pageAt[place]], number = printedAt(place).text, item = ownerOf(place);
    const owner = item === place ? "" : `${printedAt(item).text} ${textsOf(item)[0]}`;
    const kindOfItem = page.kind || (/^0x[0-9A-F]{4}(:|$)/i.test(number) ? "object" : "");
    const kind = number || page.kind === "device" ? kindOfItem : "page";
    const more = element("small", { textContent: [owner, kind, names, unit, page.title].filter(Boolean).join(" · ") });
    const link = element("a", { role: "option", id: "found-" + at, href: linkOf(place), tabIndex: -1 }, `${number} ${name} `.trimStart(), more);
    return element("li", { role: "presentation" }, link);
  }));
  found.hidden = !list.length;
  input.setAttribute("aria-expanded", String(list.length > 0));
  announcement.textContent = list.length || !isComplete() || !input.value.trim() ? "" : "Nothing found.";
  isChosen = false;
  select(0);
}

// Set if the reader selected a result with an arrow key.
let isChosen = false;

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

function choose(at) {
  isEntered = false;
  select(at);
  isChosen = found.querySelector("a") !== null;
}

function close() {
  isEntered = false;
  found.hidden = true;
  announcement.textContent = "";
  input.setAttribute("aria-expanded", "false");
}

// Set if the reader pressed Enter before the whole index was read.
let isEntered = false;

// Opens the selected result. Until the whole index is read, only a result that the reader chose is opened at once.
function enter() {
  const link = found.querySelectorAll("a")[selected];
  isEntered = !isComplete() && !isChosen;
  if (link && !isEntered) { close(); location.href = link.href; }
}

// Set if an index was read while the reader was elsewhere.
let isOutdated = false;

// Repeats the search with a larger index. A result that the reader chose stays selected. After Enter, the first result is opened if it is
// still the first one.
function searchAgain() {
  isOutdated = document.activeElement !== input;
  if (isOutdated) return;
  const { href } = found.querySelectorAll("a")[selected] ?? {}, wasEntered = isEntered, wasChosen = isChosen;
  search();
  const links = [...found.querySelectorAll("a")], at = links.findIndex((link) => link.href === href);
  isChosen = wasChosen && at >= 0;
  if (isChosen) select(at);
  if (!isComplete()) return;
  isEntered = false;
  if (wasEntered && links.length && (at === 0 || href === undefined)) enter();
}

// A search usually begins on a page with a list of devices, so such a page loads the index before the reader types.
if (deviceFilter) {
  loadFirst();
  addEventListener("load", () => whenIdle(load));
}
input.addEventListener("focus", () => { load(); if (isOutdated) searchAgain(); });
input.addEventListener("blur", () => { isEntered = false; });
input.addEventListener("input", () => { isEntered = false; search(); });
input.addEventListener("keydown", (event) => {
  if (event.key === "ArrowDown") choose(selected + 1);
  else if (event.key === "ArrowUp") choose(selected - 1);
  else if (event.key === "Escape") { close(); input.blur(); }
  else if (event.key === "Enter") enter();
  else return;
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

// Returns the address in the URL if this page does not have it.
function missingAddress() {
  const address = addressOfUrl();
  return byId(address) || byId(withoutPart(address)) ? "" : plain(address);
}

// Opens the page that contains the address. The row of an item also shows bits and values that the index has in another row. If an entry
// has no separate row, opens the row of its object.
function lead() {
  const address = missingAddress(), item = withoutPart(address);
  for (const candidate of address ? [address, item, item.split(":")[0]] : []) {
    const place = entryAt.findIndex((_, place) => plain(anchorOf(place)) === candidate);
    if (place < 0) continue;
    location.replace(linkOf(place) + (candidate === item ? encodeURIComponent(address.slice(item.length)) : ""));
    return;
  }
}

function leadOrLoad() {
  if (isLoaded) lead();
  else if (missingAddress()) load();
}
addEventListener("hashchange", leadOrLoad);
