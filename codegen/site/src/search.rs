//! Creates the search index. The index is a script that a page loads when the reader starts a search. In a site with
//! many devices, many entries have the same number or text. The index stores each number and text once, so a search
//! also checks it once.

use std::collections::HashMap;
use std::fmt::Write;

use super::words::one_line as line;

/// Number of characters at the start of a description that are searchable.
const WORDS: usize = 80;

/// A search index.
#[derive(Debug, Default)]
pub(super) struct Index {
    devices: Vec<Device>,
    /// Pages of the devices with their entries.
    pages: Vec<Page>,
    numbers: Texts,
    /// Searchable texts: name, names in other languages, unit, and the start of the description. Tabs separate these
    /// texts.
    texts: Texts,
}

/// A device in the index.
#[derive(Clone, Debug)]
struct Device {
    title: String,
    /// Further searchable words: vendor, order code, identity.
    words: String,
    /// The revision or file, which the search shows if several devices have the same title.
    distinction: String,
}

#[derive(Debug)]
struct Page {
    path: String,
    /// Position of the device in the list of devices.
    device: usize,
    /// Kind of the entries on the page, such as `state`. The text is empty for items, which have addresses.
    kind: &'static str,
    entries: Vec<IndexedEntry>,
}

/// An entry in the index: its anchor, and the positions of its number and text in the lists.
#[derive(Debug)]
struct IndexedEntry {
    /// Anchor within the page; empty if the anchor equals the number.
    anchor: String,
    number: usize,
    text: usize,
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

/// A list of texts without duplicates, in the order of their first occurrence.
#[derive(Debug, Default)]
struct Texts {
    all: Vec<String>,
    positions: HashMap<String, usize>,
}

impl Texts {
    fn position(&mut self, text: &str) -> usize {
        if let Some(position) = self.positions.get(text) {
            return *position;
        }
        let position = self.all.len();
        self.all.push(text.to_owned());
        self.positions.insert(text.to_owned(), position);
        position
    }
}

impl Index {
    /// Adds a device. Pages that are added later belong to this device. `words` are found together with each entry of the device.
    /// `distinction` is shown after the title if several devices have this title.
    pub fn device(&mut self, title: &str, words: &str, distinction: &str) {
        self.devices.push(Device { title: line(title), words: line(words), distinction: line(distinction) });
    }

    /// Adds a page of the last device. `path` is relative to the site's folder. Entries that are added later belong to this page.
    pub fn page(&mut self, path: &str, kind: &'static str) {
        let device = self.devices.len().saturating_sub(1);
        self.pages.push(Page { path: path.to_owned(), device, kind, entries: Vec::new() });
    }

    /// Adds an entry to the last page.
    pub fn entry(&mut self, entry: &Entry<'_>) {
        let names: Vec<String> = entry.names.iter().map(|(_, name)| line(name)).collect();
        let words: String = line(entry.words).chars().take(WORDS).collect();
        let text = [line(entry.name), names.join(" | "), line(entry.unit), words].join("\t");
        let (number, text) = (self.numbers.position(&line(entry.number)), self.texts.position(&text));
        let anchor = if entry.anchor == entry.number { String::new() } else { line(entry.anchor) };
        if let Some(page) = self.pages.last_mut() {
            page.entries.push(IndexedEntry { anchor, number, text });
        }
    }

    /// Adds the pages and entries of another index.
    pub fn add(&mut self, other: &Index) {
        let numbers: Vec<usize> = other.numbers.all.iter().map(|number| self.numbers.position(number)).collect();
        let texts: Vec<usize> = other.texts.all.iter().map(|text| self.texts.position(text)).collect();
        let indexed = |entry: &IndexedEntry| IndexedEntry {
            anchor: entry.anchor.clone(),
            number: numbers[entry.number],
            text: texts[entry.text],
        };
        let first = self.devices.len();
        self.devices.extend(other.devices.iter().cloned());
        self.pages.extend(other.pages.iter().map(|page| Page {
            path: page.path.clone(),
            device: first + page.device,
            kind: page.kind,
            entries: page.entries.iter().map(indexed).collect(),
        }));
    }

    /// Returns the index as a script. Texts are JSON strings, so the browser does not execute them.
    pub fn script(&self) -> String {
        let json = |text: &str| serde_json::to_string(text).unwrap_or_default();
        let mut titles: HashMap<&str, usize> = HashMap::new();
        self.devices.iter().for_each(|device| *titles.entry(&device.title).or_default() += 1);
        let shown = |Device { title, distinction, .. }: &Device| match titles.get(title.as_str()) {
            Some(2..) if !distinction.is_empty() => format!("{title} ({distinction})"),
            _ => title.clone(),
        };
        let devices = self.devices.iter().map(|device| format!("[{},{}]", json(&shown(device)), json(&device.words)));
        let devices = devices.collect::<Vec<_>>().join(",");
        let pages = self.pages.iter().map(|page| format!("[{},{},{}]", json(&page.path), page.device, json(page.kind)));
        let pages = pages.collect::<Vec<_>>().join(",");
        let anchors: Vec<&str> =
            self.pages.iter().flat_map(|page| &page.entries).map(|entry| entry.anchor.as_str()).collect();
        let lists = [&self.numbers.all.join("\n"), &self.texts.all.join("\n"), &anchors.join("\n")];
        let lists = lists.map(|list| json(list)).join(",\n");
        let mut script = format!("lexibusIndex([{devices}],\n[{pages}],\n{lists},\n[");
        for (at, page) in self.pages.iter().enumerate() {
            script.push_str(if at == 0 { "[" } else { ",[" });
            for (at, entry) in page.entries.iter().enumerate() {
                let comma = if at == 0 { "" } else { "," };
                let _ = write!(script, "{comma}{},{}", entry.number, entry.text);
            }
            script.push(']');
        }
        script + "]);\n"
    }
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
        one.device("A", "Vendor", "0x00000001");
        one.page("a.html", "");
        one.entry(&entry("0x6040", "Control\nword"));
        one.entry(&entry("word", "first"));
        all.device("X", "", "");
        all.page("x.html", "state");
        all.entry(&entry("0x6040", "first"));
        all.add(&one);
        let expected = r#"lexibusIndex([["X",""],["A","Vendor"]],
[["x.html",0,"state"],["a.html",1,""]],
"0x6040",
"first\t\t\tTakes commands\nControl word\t\t\tTakes commands",
"\n\nword",
[[0,0],[0,1,0,0]]);"#;
        assert_eq!(all.script().trim_end(), expected);
        all.device("A", "Vendor", "0x00000002");
        let expected = r#"[["X",""],["A (0x00000001)","Vendor"],["A (0x00000002)","Vendor"]]"#;
        assert!(all.script().contains(expected), "{}", all.script());
    }
}
