// Written by lexibus docs.
"use strict";
// What the index of a site, or of one device, has: pages with their titles, numbers, texts, and entries, each of which is a page,
// an address within it, a number and a text. Texts are name, names in other languages, unit and description.
let pages = [], titles = [], numbers = [], texts = [], anchors = [], isLoading = false, isLoaded = false;
// Of each entry: where it is in the lists above.
let pageOf, numberOf, textOf;

// Capitals and accents make no difference.
const plain = (text) => text.replace(/[\u00c0-\u024f]/g, (letter) => letter.normalize("NFD")[0]).toLowerCase();

function lexibusIndex(list, ownNumbers, ownTexts, ownAnchors, entries) {
  pages = list.map(([path, title]) => ({ path, title }));
  titles = list.map(([, title]) => plain(title));
  numbers = ownNumbers.split("\n").map(numberFrom);
  texts = ownTexts.split("\n").map((line) => ({ fields: line.split("\t"), plain: plain(line).split("\t") }));
  anchors = ownAnchors.split("\n");
  [pageOf, numberOf, textOf] = [0, 1, 2].map(() => new Uint32Array(anchors.length));
  let at = 0;
  for (const [page, own] of entries.entries()) {
    for (let next = 0; next < own.length; next += 2, at++) [pageOf[at], numberOf[at], textOf[at]] = [page, own[next], own[next + 1]];
  }
  isLoaded = true;
  lead();
  search();
}

// `0x6040:01`, `register 12–13 (wire 11–12)`, `0x6100 to 0x61FF`: what is written, and the first and last number of each range.
function numberFrom(text) {
  const range = (pattern) => {
    const [, first, last] = plain(text).match(pattern) || [];
    return { first: Number(first), last: Number(last ?? first) };
  };
  const printed = range(/^(?:[a-z_ ]+ )?(0x[0-9a-f]+|[0-9]+)(?:(?: to |–)(0x[0-9a-f]+|[0-9]+))?/);
  return { text, plain: plain(text), ranges: [printed, range(/\(wire (0x[0-9a-f]+|[0-9]+)(?:–(0x[0-9a-f]+|[0-9]+))?\)/)] };
}

// The folder of the index, where that isn't the page's.
const folder = document.documentElement.dataset.index || "";
const byId = (id) => document.getElementById(id);
const input = byId("search"), found = byId("found");

function load() {
  if (isLoading) return;
  isLoading = true;
  const script = document.createElement("script");
  script.src = folder + "search.js";
  document.head.append(script);
}

// What numbers a word may be: indices are written without 0x, too.
function values(word) {
  const all = /^(0x[0-9a-f]+|[0-9]+)$/.test(word) ? [Number(word)] : [];
  return /^[0-9a-f]{4}$/.test(word) ? [...all, parseInt(word, 16)] : all;
}

// Points of a number, of a text and of a title for a word; 0 where it isn't there.
function numberPoints(own, { word, hex, values }) {
  if (own.plain === word || own.plain === hex) return 150;
  for (const { first, last } of own.ranges) {
    if (values.includes(first)) return own.plain.includes(":") ? 90 : 100;
    if (values.some((value) => first < value && value <= last)) return 60;
  }
  return own.plain.includes(word) ? 20 : 0;
}

function textPoints([name, names, ...rest], word) {
  let points = 0;
  if (name === word) points += 100;
  if (name.startsWith(word)) points += 30;
  if (name.includes(word)) points += 10;
  if (names.includes(word)) points += 8;
  return points || Number(rest.some((field) => field.includes(word)));
}

function each(list, points) {
  const all = new Uint16Array(list.length);
  for (let at = 0; at < list.length; at++) all[at] = points(list[at]);
  return all;
}

// Points for a word by number, by text and by page. Words that stay while the next one is typed are known.
const known = new Map();

function pointsOf(word) {
  if (!known.has(word)) {
    if (known.size > 20) known.clear();
    const own = { word, hex: "0x" + word, values: values(word) };
    known.set(word, {
      numbers: each(numbers, (number) => numberPoints(number, own)),
      texts: each(texts, (text) => textPoints(text.plain, word)),
      titles: each(titles, (title) => Number(title.includes(word))),
    });
  }
  return known.get(word);
}

// So many results are shown.
const MOST = 50;

// Adds the points of a word to those of each entry, which have none any more where it is neither in them nor in the title.
function add({ numbers, texts, titles }, sums) {
  for (let entry = 0; entry < sums.length; entry++) {
    const own = numbers[numberOf[entry]] + texts[textOf[entry]];
    sums[entry] = sums[entry] < 0 || own === 0 && titles[pageOf[entry]] === 0 ? -1 : sums[entry] + own;
  }
}

// Entries that have each of the words, the best first, and of equally good ones the first. What is in titles alone is none.
function matches(query) {
  const words = plain(query).split(/\s+/).filter(Boolean), best = [];
  if (!words.length || !isLoaded) return best;
  const sums = new Int32Array(anchors.length);
  for (const word of words) add(pointsOf(word), sums);
  for (let entry = 0, least = 0; entry < sums.length; entry++) {
    if (sums[entry] > least) least = insert(best, { points: sums[entry], entry });
  }
  // A row has an entry for each of its addresses; the best one is shown.
  const links = new Set();
  return best.map(({ entry }) => entry).filter((entry) => !links.has(linkOf(entry)) && links.add(linkOf(entry))).slice(0, MOST);
}

// Gives the points that a further entry has to surpass.
function insert(best, own) {
  const place = best.findIndex((other) => other.points < own.points);
  best.splice(place < 0 ? best.length : place, 0, own);
  if (best.length > 4 * MOST) best.pop();
  return best.length === 4 * MOST ? best[best.length - 1].points : 0;
}

const anchorOf = (entry) => anchors[entry] || numbers[numberOf[entry]].text;
const linkOf = (entry) => folder + pages[pageOf[entry]].path + "#" + encodeURIComponent(anchorOf(entry));

let selected = 0;
const said = document.createElement("p");
said.setAttribute("role", "status");
found.after(said);

function search() {
  const list = matches(input.value);
  found.replaceChildren(...list.map((entry, at) => {
    const [name, names, unit] = texts[textOf[entry]].fields, page = pages[pageOf[entry]];
    const item = document.createElement("li"), link = document.createElement("a"), more = document.createElement("small");
    item.role = "presentation";
    link.role = "option";
    link.id = "found-" + at;
    link.href = linkOf(entry);
    link.tabIndex = -1;
    link.textContent = numbers[numberOf[entry]].text + " " + name + " ";
    more.textContent = [names, unit, page.title].filter(Boolean).join(" · ");
    link.append(more);
    item.append(link);
    return item;
  }));
  found.hidden = !list.length;
  input.setAttribute("aria-expanded", String(list.length > 0));
  said.textContent = list.length || !isLoaded || !input.value.trim() ? "" : "Nothing found.";
  select(0);
}

function select(at) {
  const items = found.querySelectorAll("a");
  selected = Math.max(0, Math.min(at, items.length - 1));
  for (const [place, item] of [...items].entries()) item.setAttribute("aria-selected", String(place === selected));
  if (items[selected]) {
    input.setAttribute("aria-activedescendant", items[selected].id);
    items[selected].scrollIntoView({ block: "nearest" });
  } else {
    input.removeAttribute("aria-activedescendant");
  }
}

function close() {
  found.hidden = true;
  said.textContent = "";
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
  if (event.key === "/" && !event.ctrlKey && !event.metaKey && !/INPUT|SELECT/.test(document.activeElement.tagName)) {
    event.preventDefault();
    input.focus();
  }
});

// What was chosen stays chosen, where the browser keeps anything.
const kept = (key, value) => {
  try {
    if (value !== undefined) localStorage.setItem(key, value);
    return localStorage.getItem(key) || "";
  } catch { return ""; }
};

const root = document.documentElement;
if (kept("theme")) root.dataset.theme = kept("theme");
byId("theme").addEventListener("click", () => {
  const dark = root.dataset.theme ? root.dataset.theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
  root.dataset.theme = kept("theme", dark ? "light" : "dark");
});

// Names and descriptions in the language that is chosen: of elements that have none in it, the name of the description.
function names(language) {
  for (const own of document.querySelectorAll(":is(i, p)[lang]")) own.hidden = language !== "" && own.lang !== language;
  for (const own of document.querySelectorAll("b:has(+ i[lang])")) {
    const others = [];
    for (let next = own.nextElementSibling; next && next.matches("i[lang]"); next = next.nextElementSibling) others.push(next);
    own.hidden = others.some((other) => other.lang === language);
  }
}
const language = byId("language");
if (language) {
  language.value = kept("language");
  names(language.value);
  language.addEventListener("change", () => names(kept("language", language.value)));
}

// What a program writes is copied with a button, which only pages with a script have.
for (const code of document.querySelectorAll("p > code:only-child")) {
  const button = document.createElement("button");
  button.type = "button";
  button.textContent = "Copy";
  button.className = "copy";
  button.addEventListener("click", () => {
    navigator.clipboard?.writeText(code.textContent).then(() => { button.textContent = "Copied"; }, () => getSelection().selectAllChildren(code));
  });
  code.after(" ", button);
}

// What is wider than the page is scrolled in its own box, which the keyboard reaches then.
const boxes = new ResizeObserver((list) => {
  for (const { target } of list) {
    if (target.scrollWidth > target.clientWidth) target.tabIndex = 0;
    else target.removeAttribute("tabindex");
  }
});
for (const box of document.querySelectorAll(".wide, pre")) boxes.observe(box);

// Of many pages, the one that is open is in sight.
const open = document.querySelector("nav [aria-current]");
if (open) open.parentElement.scrollTop = open.offsetTop - open.parentElement.offsetTop - open.offsetHeight;

// The address that is wanted, where this page hasn't it.
function wanted() {
  let address = location.hash.slice(1);
  try { address = decodeURIComponent(address); } catch { /* Then it is no text in UTF-8, and stays what it is. */ }
  return document.getElementById(address) ? "" : plain(address);
}

// Leads to the page that has it; an entry may be in the row of its object.
function lead() {
  const address = wanted();
  for (const own of address ? [address, address.split(":")[0]] : []) {
    const entry = anchors.findIndex((_, entry) => plain(anchorOf(entry)) === own);
    if (entry < 0) continue;
    location.replace(linkOf(entry));
    return;
  }
}

function leadOrLoad() {
  if (isLoaded) lead();
  else if (wanted()) load();
}
addEventListener("hashchange", leadOrLoad);
leadOrLoad();
