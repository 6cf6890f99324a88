// Written by lexibus docs.
"use strict";
// The frame of a page: theme, language, tree of pages, contents.
const root = document.documentElement;
const byId = (id) => document.getElementById(id);

// Creates an element with these properties and children.
const element = (tag, properties, ...children) => {
  const created = Object.assign(document.createElement(tag), properties);
  created.append(...children);
  return created;
};

// Returns the address in the URL. An address that is not UTF-8 stays as it is.
function addressOfUrl() {
  const address = location.hash.slice(1);
  try { return decodeURIComponent(address); } catch { return address; }
}

// Returns a text without capitals and accents, which the search ignores.
const plain = (text) => text.replace(/[\u00c0-\u024f]/g, (letter) => letter.normalize("NFD")[0]).toLowerCase();

// Stores a choice of the reader and returns it. Some browsers store nothing.
const kept = (key, value) => {
  try {
    if (value !== undefined) localStorage.setItem(key, value);
    return localStorage.getItem(key) || "";
  } catch { return ""; }
};

if (kept("theme")) root.dataset.theme = kept("theme");
byId("theme").addEventListener("click", () => {
  const dark = root.dataset.theme ? root.dataset.theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
  root.dataset.theme = kept("theme", dark ? "light" : "dark");
});

// Returns the languages of a translation. Languages with the same text share one element.
const languagesOf = (text) => (text.title || text.lang).split(", ");

// Shows names and descriptions in the selected language. Elements without a name in it keep the name of the source.
function names(language) {
  for (const text of document.querySelectorAll(":is(i, p)[lang]")) text.hidden = language !== "" && !languagesOf(text).includes(language);
  for (const name of document.querySelectorAll("b:has(+ i[lang])")) {
    const others = [];
    for (let next = name.nextElementSibling; next && next.matches("i[lang]"); next = next.nextElementSibling) others.push(next);
    name.hidden = others.some((other) => languagesOf(other).includes(language));
  }
}
const language = byId("language");
if (language) {
  language.value = kept("language");
  names(language.value);
  language.addEventListener("change", () => names(kept("language", language.value)));
}

// Returns a button that copies the text of an element.
function copyButton(code) {
  const button = element("button", { type: "button", className: "copy", textContent: "Copy" });
  button.addEventListener("click", () => {
    navigator.clipboard?.writeText(code.textContent).then(() => { button.textContent = "Copied"; }, () => getSelection().selectAllChildren(code));
  });
  return button;
}

// Lets the keyboard reach elements that are wider than the page and scroll.
const boxes = new ResizeObserver((list) => {
  for (const { target } of list) {
    if (target.scrollWidth > target.clientWidth) target.tabIndex = 0;
    else target.removeAttribute("tabindex");
  }
});
for (const box of document.querySelectorAll(".wide, pre")) boxes.observe(box);

// The tree of pages. The contents of the open page are below its entry: objects of a table, otherwise headings.
const tree = byId("tree"), open = tree?.querySelector("[aria-current]");

// Returns copies of the parts of a heading, with names as elements, so that the choice of the language applies to them.
const copies = (parts) => [...parts].map((part) => part.nodeName === "A" ? part.textContent : part.cloneNode(true));

function contents() {
  const objects = [...document.querySelectorAll("tbody.object[id]")];
  const sections = objects.length ? objects : [...document.querySelectorAll("main :is(section, h2)[id]")];
  return sections.map((section) => {
    const heading = section.matches("h2") ? section : section.querySelector("h2, h3") ?? section.querySelector("tr");
    const row = heading.matches("tr") && heading.cells;
    const parts = row ? [row[0].textContent, " ", ...copies(row[1].querySelectorAll(":scope > :is(b, i)"))] : copies(heading.childNodes);
    return element("li", {}, element("a", { href: "#" + section.id }, ...parts));
  });
}

if (open) {
  const list = contents();
  if (list.length) open.after(element("ul", { id: "contents" }, ...list));
  // Scrolls the tree to the open page.
  tree.scrollTop = open.offsetTop - tree.offsetHeight / 3;
}

// Hides the entries of the tree that contain neither the typed text nor an entry with it.
byId("filter")?.addEventListener("input", ({ target }) => {
  const typed = plain(target.value.trim());
  for (const item of [...tree.querySelectorAll("li")].reverse()) {
    item.hidden = !plain(item.firstElementChild.textContent).includes(typed) && !item.querySelector("li:not([hidden])");
  }
});

// Printed pages contain the texts that are folded on the screen.
let unfolded = [];
addEventListener("beforeprint", () => {
  unfolded = [...document.querySelectorAll("main details:not([open], .tools)")];
  for (const details of unfolded) details.open = true;
});
addEventListener("afterprint", () => {
  for (const details of unfolded) details.open = false;
});

// The drawer with the tree on narrow screens.
const menu = byId("menu");
menu?.addEventListener("click", () => {
  const isOpen = root.classList.toggle("menu");
  menu.setAttribute("aria-expanded", String(isOpen));
  if (isOpen) byId("close").focus();
});
document.addEventListener("click", ({ target }) => {
  const isInside = target.closest("#tree, #menu") && !target.closest("#tree a, #close");
  if (!isInside && root.classList.contains("menu")) menu.click();
});
tree?.addEventListener("keydown", ({ key }) => {
  if (key !== "Escape" || !root.classList.contains("menu")) return;
  menu.click();
  menu.focus();
});
