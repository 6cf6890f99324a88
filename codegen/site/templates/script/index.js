// The index of the search.
// The index of a site or of one device: devices with their titles, further words and pages, pages with their device and kind, numbers,
// texts and anchors. An entry has a number, a text and an anchor; the entry of a whole page has no number. A text contains name, names
// in other languages, unit and description. Equal entries of several pages are one entry with several places.
let pages = [], titles = [], numbers = [], texts = [], anchors = [];
// For each entry, the positions of its number, text and anchor in these lists.
let numberAt = new Uint32Array(), textAt = numberAt, anchorAt = numberAt;
// For each place, the positions of its page and entry. The places of a page are consecutive.
let pageAt = numberAt, entryAt = numberAt;
// Whether the scripts are requested, and whether the whole index can be searched or cannot be loaded.
let isFirstLoading = false, isLoading = false, isLoaded = false, isMissing = false;

// The folder of the site, and the folder of the index.
const site = root.dataset.root + "/", folder = site + (root.dataset.index || "");
// The index of a site has a small first part, which the scripts load before the whole index.
const hasFirst = root.dataset.index === undefined;

const whenIdle = (work) => window.requestIdleCallback ? requestIdleCallback(work, { timeout: 1000 }) : setTimeout(work, 200);
const loadScript = (file, onerror = null) => document.head.append(element("script", { src: folder + file, onerror }));

function loadFirst() {
  if (!hasFirst || isFirstLoading) return;
  isFirstLoading = true;
  loadScript("search-first.js");
}

function load() {
  loadFirst();
  if (isLoading) return;
  isLoading = true;
  loadScript("search.js", indexIsMissing);
}

// Receives the index from its script. The whole index is read in several tasks, so the page answers keystrokes in between. Until then,
// the search uses the first part.
function lexibusIndex(...lists) {
  const steps = reading(...lists);
  const step = () => steps.next().done ? indexIsRead() : setTimeout(step);
  step();
}

// Receives the first part of the index.
function lexibusIndexFirst(...lists) {
  if (isLoaded) return;
  for (const _ of reading(...lists));
  answer();
}

// Answers what the reader typed before the index was read.
function answer() {
  searchAgain();
  if (deviceFilter?.value) deviceFilter.dispatchEvent(new Event("input"));
}

function indexIsRead() {
  isLoaded = true;
  lead();
  answer();
  // The first search for a number determines the ranges of all numbers, which takes longer than the next searches.
  whenIdle(() => pointsOf("0"));
}

// If the whole index cannot be loaded, the search uses only the first part.
function indexIsMissing() {
  isMissing = true;
  known.clear();
  answer();
}

// Reads an index in steps. After the last step, the search uses this index.
function* reading(devices, numberLines, textLines, anchorLines, differences, runs) {
  const newPages = devices.flatMap(([title, , folder, ...files], device) => {
    const pairs = Array.from({ length: files.length / 2 }, (_, at) => files.slice(2 * at, 2 * at + 2));
    return pairs.map(([file, kind]) => ({ path: folder + "/" + file, kind, device, title }));
  });
  const newTitles = devices.map(([title, words]) => plain(title + " " + words));
  yield;
  const newNumbers = linesOf(numberLines).map(([text, plain]) => ({ text, plain, isPart: PART.test(text), ranges: undefined }));
  yield;
  const textPairs = linesOf(textLines);
  yield;
  const newTexts = textPairs.map(([text, plain]) => ({ text, plain, nameEnd: plain.indexOf("\t") }));
  yield;
  const newEntries = entriesOf(JSON.parse(`[${differences}]`));
  yield;
  const newPlaces = placesOf(newPages.length, JSON.parse(`[${runs}]`));
  [pages, titles, numbers, texts, anchors] = [newPages, newTitles, newNumbers, newTexts, anchorLines.split("\n")];
  [[numberAt, textAt, anchorAt], [pageAt, entryAt]] = [newEntries, newPlaces];
  known.clear();
  vocabulary = undefined;
}

// Returns the entries. Each of their three numbers is the difference from the entry before.
function entriesOf(differences) {
  return [0, 1, 2].map((part) => {
    const all = new Uint32Array(differences.length / 3);
    for (let entry = 0, sum = 0; entry < all.length; entry++) all[entry] = sum += differences[3 * entry + part];
    return all;
  });
}

// Returns page and entry of the places. Each page has the number of its runs, then two numbers per run: the difference of its first entry
// from the end of the run before, and its length.
function placesOf(pageCount, runs) {
  // Calls `visit` with the page, first entry and length of each run.
  const each = (visit) => {
    for (let page = 0, at = 0, entry = 0; page < pageCount; page++) {
      for (let count = runs[at++]; count > 0; count--, at += 2) {
        visit(page, entry + runs[at], runs[at + 1]);
        entry += runs[at] + runs[at + 1];
      }
    }
  };
  let length = 0, place = 0;
  each((page, first, count) => { length += count; });
  const pagesOfPlaces = new Uint32Array(length), entries = new Uint32Array(length);
  each((page, first, count) => {
    pagesOfPlaces.fill(page, place, place + count);
    for (let entry = first; entry < first + count; entry++) entries[place++] = entry;
  });
  return [pagesOfPlaces, entries];
}

// Returns each line with its plain text.
function linesOf(lines) {
  const plainLines = plain(lines).split("\n");
  return lines.split("\n").map((line, at) => [line, plainLines[at]]);
}
