//! Creates the search index. The index is a script that a page loads when it is idle or when the reader starts a search. In a
//! site with many devices, many entries are equal. The index stores each number, text, anchor and entry once, so it loads
//! fast, and a search checks each entry once. The index of a site has a small first part, which answers the first keystrokes
//! while the browser loads the whole index.

use std::cmp::Reverse;
use std::collections::{HashMap, HashSet};
use std::fmt::Write;
use std::hash::Hash;

use super::words::one_line as line;

/// Number of characters at the start of a description that are searchable.
const WORDS: usize = 80;

/// Kind of a page that describes a device. The first entry of such a page is the device.
pub(super) const DEVICE: &str = "device";

/// Maximum number of entries in the first part of the index for each first character of a name or number.
const FIRST: usize = 50;

/// A search index.
#[derive(Debug, Default)]
pub(super) struct Index {
    /// Devices with their pages.
    devices: Vec<Device>,
    numbers: Distinct<String>,
    /// Searchable texts: name, names in other languages, unit, and the start of the description. Tabs separate these
    /// texts.
    texts: Distinct<String>,
    /// Anchors within a page. An anchor that equals the number is stored as an empty text.
    anchors: Distinct<String>,
    /// Entries: positions of the number, text and anchor in the three lists above.
    entries: Distinct<[usize; 3]>,
}

/// A device in the index.
#[derive(Clone, Debug)]
struct Device {
    title: String,
    /// Further searchable words: vendor, order code, identity.
    words: String,
    /// The revision or file, followed by the note. The search shows this text if several devices have the same title.
    distinction: String,
    /// Folder of the pages, relative to the site's folder.
    folder: String,
    pages: Vec<Page>,
}

#[derive(Clone, Debug)]
struct Page {
    file: String,
    /// Kind of the entries on the page, such as `state`. Empty for items, because their addresses already identify them as items.
    kind: &'static str,
    /// Positions of the page's entries in the list of entries.
    entries: Vec<usize>,
}

/// An entry to add to the index.
pub(super) struct Entry<'e> {
    pub anchor: &'e str,
    pub number: &'e str,
    pub name: &'e str,
    /// Names of the entry in other languages.
    pub names: &'e [(String, String)],
    pub unit: &'e str,
    pub words: &'e str,
}

/// A list of values without duplicates, in the order of first occurrence.
#[derive(Debug)]
struct Distinct<T> {
    all: Vec<T>,
    positions: HashMap<T, usize>,
}

impl<T> Default for Distinct<T> {
    fn default() -> Self {
        Distinct { all: Vec::new(), positions: HashMap::new() }
    }
}

impl<T: Clone + Eq + Hash> Distinct<T> {
    fn position(&mut self, value: T) -> usize {
        let all = &mut self.all;
        *self.positions.entry(value).or_insert_with_key(|value| {
            all.push(value.clone());
            all.len() - 1
        })
    }

    /// Adds the values of another list. Returns their positions in this list.
    fn add(&mut self, other: &Self) -> Vec<usize> {
        other.all.iter().map(|value| self.position(value.clone())).collect()
    }
}

impl Index {
    /// Adds a device, whose pages are in `folder`, relative to the site's folder. Pages that are added later belong to this device.
    /// A search can combine `words` with the text of any entry of the device. `distinction` is shown after the title if several
    /// devices have this title.
    pub fn device(&mut self, title: &str, words: &str, distinction: &str, folder: &str) {
        let (title, words, distinction) = (line(title), line(words), line(distinction));
        self.devices.push(Device { title, words, distinction, folder: folder.to_owned(), pages: Vec::new() });
    }

    /// Adds a page to the last device. Entries that are added later belong to this page.
    pub fn page(&mut self, file: &str, kind: &'static str) {
        if let Some(device) = self.devices.last_mut() {
            device.pages.push(Page { file: file.to_owned(), kind, entries: Vec::new() });
        }
    }

    /// Adds an entry to the last page.
    pub fn entry(&mut self, entry: &Entry<'_>) {
        let names: Vec<String> = entry.names.iter().map(|(_, name)| line(name)).collect();
        let words: String = line(entry.words).chars().take(WORDS).collect();
        let text = [line(entry.name), names.join(" | "), line(entry.unit), words].join("\t");
        let anchor = if entry.anchor == entry.number { String::new() } else { line(entry.anchor) };
        let (number, text) = (self.numbers.position(line(entry.number)), self.texts.position(text));
        let position = self.entries.position([number, text, self.anchors.position(anchor)]);
        if let Some(page) = self.devices.last_mut().and_then(|device| device.pages.last_mut()) {
            page.entries.push(position);
        }
    }

    /// Adds the devices, pages and entries of another index.
    pub fn add(&mut self, other: &Index) {
        let lists = [self.numbers.add(&other.numbers), self.texts.add(&other.texts), self.anchors.add(&other.anchors)];
        let moved = |entry: &[usize; 3]| [lists[0][entry[0]], lists[1][entry[1]], lists[2][entry[2]]];
        let entries: Vec<usize> = other.entries.all.iter().map(|entry| self.entries.position(moved(entry))).collect();
        self.devices.extend(other.devices.iter().map(|device| {
            let mut device = device.clone();
            let positions = device.pages.iter_mut().flat_map(|page| &mut page.entries);
            positions.for_each(|position| *position = entries[*position]);
            device
        }));
    }

    /// Returns the first part of the index: all devices, and up to [`FIRST`] entries for each first character of a name
    /// or number. These are the entries that occur on the most pages. Each entry is listed only on the first of its
    /// pages.
    fn first(&self) -> Index {
        let mut chosen = self.chosen();
        let mut first = Index::default();
        for device in &self.devices {
            first.devices.push(Device { pages: Vec::new(), ..device.clone() });
            for page in &device.pages {
                let (of_device, others) =
                    page.entries.split_at(usize::from(page.kind == DEVICE).min(page.entries.len()));
                let others = others.iter().filter(|entry| chosen.remove(entry));
                let entries: Vec<usize> =
                    of_device.iter().chain(others).map(|entry| first.copy(self, *entry)).collect();
                if let (Some(device), false) = (first.devices.last_mut(), entries.is_empty()) {
                    device.pages.push(Page { entries, ..page.clone() });
                }
            }
        }
        first
    }

    /// Returns the entries of the first part, apart from those of devices.
    fn chosen(&self) -> HashSet<usize> {
        let mut counts = vec![0_usize; self.entries.all.len()];
        let pages = self.devices.iter().flat_map(|device| &device.pages);
        for page in pages {
            page.entries.iter().skip(usize::from(page.kind == DEVICE)).for_each(|entry| counts[*entry] += 1);
        }
        let mut by_count: Vec<usize> = (0..counts.len()).collect();
        by_count.sort_by_key(|entry| Reverse(counts[*entry]));
        let mut numbers_of: HashMap<char, usize> = HashMap::new();
        let mut is_chosen = |entry: &usize| {
            let [number, text, _] = self.entries.all[*entry];
            let (number, text) = (self.numbers.all[number].as_str(), self.texts.all[text].as_str());
            // Skip entries without a number, such as pages. Also skip bits and values, because their numbers are relative
            // to the previous entry.
            if number.is_empty() || is_part(number) {
                return false;
            }
            // Readers type indices without `0x`, and register addresses without the word `register`.
            let digits = number.trim_start_matches(|letter: char| !letter.is_ascii_digit()).trim_start_matches("0x");
            let characters = [text, digits].map(|text| text.chars().next());
            characters.into_iter().flatten().any(|first| {
                let number = numbers_of.entry(first.to_ascii_lowercase()).or_default();
                *number += 1;
                *number <= FIRST
            })
        };
        by_count.retain(|entry| is_chosen(entry));
        by_count.into_iter().collect()
    }

    /// Adds an entry of another index. Returns its position.
    fn copy(&mut self, other: &Index, entry: usize) -> usize {
        let [number, text, anchor] = other.entries.all[entry];
        let number = self.numbers.position(other.numbers.all[number].clone());
        let text = self.texts.position(other.texts.all[text].clone());
        self.entries.position([number, text, self.anchors.position(other.anchors.all[anchor].clone())])
    }

    /// Returns the index as a script. All texts and numbers are in JSON strings, so the browser does not execute them. Lists of
    /// numbers are strings, too, because a browser reads a long string faster than a long array.
    pub fn script(&self) -> String {
        format!("lexibusIndex{}", self.arguments())
    }

    /// Returns the first part of the index as a script.
    pub fn first_script(&self) -> String {
        format!("lexibusIndexFirst{}", self.first().arguments())
    }

    fn arguments(&self) -> String {
        let devices = self.devices_of_script().join(",\n");
        let lists = [self.numbers.all.join("\n"), self.texts.all.join("\n"), self.anchors.all.join("\n")];
        let lists = lists.map(|list| json(&list)).join(",\n");
        format!("([{devices}],\n{lists},\n\"{}\",\n\"{}\");\n", self.differences(), self.runs())
    }

    /// Returns each device: title, further words, folder, and the files and kinds of its pages.
    fn devices_of_script(&self) -> Vec<String> {
        let mut titles: HashMap<&str, usize> = HashMap::new();
        self.devices.iter().for_each(|device| *titles.entry(&device.title).or_default() += 1);
        let shown = |Device { title, distinction, .. }: &Device| match titles.get(title.as_str()) {
            Some(2..) if !distinction.is_empty() => format!("{title} ({distinction})"),
            _ => title.clone(),
        };
        let device = |device: &Device| {
            let pages = device.pages.iter().map(|page| format!("{},{}", json(&page.file), json(page.kind)));
            let pages = pages.collect::<Vec<_>>().join(",");
            format!("[{},{},{},{pages}]", json(&shown(device)), json(&device.words), json(&device.folder))
        };
        self.devices.iter().map(device).collect()
    }

    /// Returns the entries. Each of the three numbers of an entry is written as the difference from the previous entry.
    fn differences(&self) -> String {
        let mut before = [0; 3];
        let mut numbers = Vec::with_capacity(3 * self.entries.all.len());
        for entry in &self.entries.all {
            numbers.extend(entry.iter().zip(before).map(|(now, before)| difference(*now, before)));
            before = *entry;
        }
        separated(&numbers)
    }

    /// Returns the entries of the pages as runs of consecutive entries. Each page is written as the number of its runs, followed by
    /// two numbers per run. The first number is the distance from the end of the previous run to the first entry of this run. The
    /// second number is the length of the run.
    fn runs(&self) -> String {
        let (mut end, mut numbers) = (0, Vec::new());
        for page in self.devices.iter().flat_map(|device| &device.pages) {
            let runs: Vec<&[usize]> = page.entries.chunk_by(|one, next| one + 1 == *next).collect();
            numbers.push(difference(runs.len(), 0));
            for run in runs {
                numbers.extend([difference(run[0], end), difference(run.len(), 0)]);
                end = run[0] + run.len();
            }
        }
        separated(&numbers)
    }
}

/// Returns whether a number belongs to a bit or value, which is a part of the previous entry.
fn is_part(number: &str) -> bool {
    ["bit ", "value "].iter().any(|kind| number.starts_with(kind))
}

fn json(text: &str) -> String {
    serde_json::to_string(text).unwrap_or_default()
}

fn difference(now: usize, before: usize) -> i64 {
    now as i64 - before as i64
}

fn separated(numbers: &[i64]) -> String {
    let mut text = String::new();
    for (at, number) in numbers.iter().enumerate() {
        let comma = if at == 0 { "" } else { "," };
        let _ = write!(text, "{comma}{number}");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    fn entry<'e>(anchor: &'e str, name: &'e str) -> Entry<'e> {
        Entry { anchor, number: "0x6040", name, names: &[], unit: "", words: "Takes\tcommands" }
    }

    #[test]
    fn indices_are_joined() {
        let (mut one, mut all) = (Index::default(), Index::default());
        one.device("A", "Vendor", "0x00000001", "a");
        one.page("index.html", "");
        one.entry(&entry("0x6040", "Control\nword"));
        one.entry(&entry("word", "first"));
        all.device("X", "", "", "x");
        all.page("index.html", "state");
        all.entry(&entry("0x6040", "first"));
        all.add(&one);
        all.page("again.html", "");
        all.entry(&entry("0x6040", "Control word"));
        all.entry(&entry("word", "first"));
        all.entry(&entry("0x6040", "first"));
        let expected = r#"lexibusIndex([["X","","x","index.html","state"],
["A","Vendor","a","index.html","","again.html",""]],
"0x6040",
"first\t\t\tTakes commands\nControl word\t\t\tTakes commands",
"\nword",
"0,0,0,0,1,0,0,-1,1",
"1,0,1,1,0,2,2,-2,2,-3,1");"#;
        assert_eq!(all.script().trim_end(), expected);
        all.device("A", "Vendor", "0x00000002", "b");
        let expected = [r#"["A (0x00000001)","Vendor","a","#, r#"["A (0x00000002)","Vendor","b",]"#];
        assert!(expected.iter().all(|device| all.script().contains(device)), "{}", all.script());
    }

    #[test]
    fn the_first_part_has_devices_and_frequent_entries() {
        let mut all = Index::default();
        let names: Vec<String> = (0..2 * FIRST + 10).map(|at| format!("Value {at}")).collect();
        for device in ["A", "B"] {
            all.device(device, "Vendor", "", device);
            all.page("index.html", DEVICE);
            all.entry(&Entry { number: "", ..entry("", device) });
            all.page("items.html", "");
            for name in &names {
                all.entry(&Entry { number: "register 1", ..entry("value", name) });
            }
            all.entry(&Entry { number: "bit 1", ..entry("bit 1", "Part") });
        }
        all.page("more.html", "");
        all.entry(&Entry { number: "register 1", ..entry("value", &names[2 * FIRST + 5]) });
        let first = all.first();
        assert_eq!(first.devices.len(), 2);
        let pages: Vec<usize> =
            first.devices.iter().flat_map(|device| &device.pages).map(|page| page.entries.len()).collect();
        // The pages list each device, and each other entry only on the first of its pages. All names begin with `V`, and all
        // numbers have the digit 1.
        assert_eq!(pages, [1, 2 * FIRST, 1]);
        let texts = first.texts.all.join("\n");
        assert!(texts.contains(&format!("Value {}\t", 2 * FIRST + 5)), "the entry on most pages: {texts}");
        assert!(!texts.contains("Part"), "{texts}");
        assert!(all
            .first_script()
            .starts_with("lexibusIndexFirst([[\"A\",\"Vendor\",\"A\",\"index.html\",\"device\","));
    }

    #[test]
    fn the_first_part_has_objects_by_their_digits() {
        let mut all = Index::default();
        all.device("A", "", "", "a");
        all.page("items.html", "");
        // These entries reach the limit for their first letter.
        let names: Vec<String> = (0..FIRST).map(|at| format!("Zone {at}")).collect();
        for name in &names {
            all.entry(&Entry { number: "register 1", ..entry("zone", name) });
            all.entry(&Entry { number: "register 1", ..entry("zone", name) });
        }
        all.entry(&entry("0x6040", "Zero-speed word"));
        let first = all.first();
        assert!(first.numbers.all.contains(&"0x6040".to_owned()), "{:?}", first.numbers.all);
        assert_eq!(first.texts.all.len(), FIRST + 1);
    }
}
