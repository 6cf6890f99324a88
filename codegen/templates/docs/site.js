"use strict";
// What the index of a site, or of one device, has: pages with their titles, and a line an entry.
let pages = [], text = "", lower = "", loading = false;

function lexibusIndex(list, lines) {
  pages = list;
  text = lines;
  lower = lines.toLowerCase();
  if (loading) search();
}

// The folder of the index, where that isn't the page's.
const folder = document.documentElement.dataset.index || "";
const byId = (id) => document.getElementById(id);
const input = byId("search"), found = byId("found");

function load() {
  if (loading) return;
  loading = true;
  const script = document.createElement("script");
  script.src = folder + "search.js";
  document.head.append(script);
}

// A number is found in both of its forms.
function forms(word) {
  if (/^0x[0-9a-f]+$/.test(word)) return [word, "\t" + parseInt(word, 16) + "\t", " " + parseInt(word, 16) + "\t"];
  if (/^[0-9]+$/.test(word)) return [word, "0x" + Number(word).toString(16)];
  if (/^[0-9a-f]{4}$/.test(word)) return [word, "0x" + word];
  return [word];
}

const MOST = 50, ENOUGH = 400;

function lineAt(at) {
  const start = lower.lastIndexOf("\n", at - 1) + 1, end = lower.indexOf("\n", at);
  return [start, end < 0 ? lower.length : end];
}

// Entries that have each of the words, the best first.
function matches(query) {
  const words = query.toLowerCase().split(/\s+/).filter(Boolean).map(forms);
  if (!words.length) return [];
  words.sort((one, other) => other[0].length - one[0].length);
  const seen = new Set(), all = [];
  for (const form of words[0]) {
    for (let at = lower.indexOf(form); at >= 0 && all.length < ENOUGH;) {
      const [start, end] = lineAt(at);
      if (!seen.has(start)) {
        seen.add(start);
        const line = lower.slice(start, end);
        if (words.every((forms) => forms.some((own) => line.includes(own)))) all.push([score(line, words), start, end]);
      }
      at = lower.indexOf(form, end);
    }
  }
  all.sort((one, other) => other[0] - one[0] || one[1] - other[1]);
  return all.slice(0, MOST);
}

function score(line, words) {
  const [, , number, name, names] = line.split("\t");
  let points = 0;
  for (const forms of words) for (const own of forms) {
    if (number === own || name === own) points += 100;
    if (number.includes(own)) points += 20;
    if (name.startsWith(own)) points += 30;
    if (name.includes(own)) points += 10;
    if (names.includes(own)) points += 8;
  }
  return points;
}

let selected = 0;

function search() {
  const list = matches(input.value.trim());
  found.replaceChildren(...list.map(([, start, end], at) => {
    const [page, anchor, number, name, names, unit] = text.slice(start, end).split("\t");
    const [path, title] = pages[page];
    const item = document.createElement("li"), link = document.createElement("a"), more = document.createElement("small");
    item.role = "option";
    item.id = "found-" + at;
    link.href = folder + path + "#" + encodeURIComponent(anchor);
    link.tabIndex = -1;
    link.textContent = number + " " + name + " ";
    more.textContent = [names, unit, title].filter(Boolean).join(" · ");
    link.append(more);
    item.append(link);
    return item;
  }));
  found.hidden = !list.length;
  input.setAttribute("aria-expanded", String(list.length > 0));
  select(0);
}

function select(at) {
  const items = found.children;
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
  input.setAttribute("aria-expanded", "false");
}

input.addEventListener("focus", load);
input.addEventListener("input", search);
input.addEventListener("keydown", (event) => {
  if (event.key === "ArrowDown") select(selected + 1);
  else if (event.key === "ArrowUp") select(selected - 1);
  else if (event.key === "Escape") { close(); input.blur(); }
  else if (event.key === "Enter") {
    const link = found.children[selected]?.querySelector("a");
    if (link) { close(); location.href = link.href; }
  } else return;
  event.preventDefault();
});
found.addEventListener("click", close);
document.addEventListener("keydown", (event) => {
  if (event.key === "/" && !/INPUT|SELECT/.test(document.activeElement.tagName)) {
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

// Names in the language that is chosen: of elements that have none in it, the name of the description.
function names(language) {
  for (const own of document.querySelectorAll("i[lang]")) own.hidden = language !== "" && own.lang !== language;
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

// An address that another page has.
if (location.hash && !document.getElementById(decodeURIComponent(location.hash.slice(1)))) {
  load();
  const wanted = decodeURIComponent(location.hash.slice(1)).toLowerCase();
  const own = lexibusIndex;
  window.lexibusIndex = (list, lines) => {
    own(list, lines);
    const at = lower.indexOf("\t" + wanted + "\t");
    if (at >= 0) {
      const [start, end] = lineAt(at), [page, anchor] = text.slice(start, end).split("\t");
      location.replace(folder + pages[page][0] + "#" + encodeURIComponent(anchor));
    }
  };
}
