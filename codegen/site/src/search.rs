//! The index of the search, in a script that pages load when somebody searches. Many entries have the same number or text, in a
//! site of many devices above all: each of them is written once, and looked through once.

use std::collections::HashMap;
use std::fmt::Write;

use super::words::one_line as line;

/// So many letters of a description are found.
const WORDS: usize = 80;

/// An index of entries.
#[derive(Debug, Default)]
pub(super) struct Index {
    /// Pages, each with the title of its device and its entries.
    pages: Vec<Page>,
    numbers: Texts,
    /// Name, names in other languages, unit and the start of the description, separated by tabs.
    texts: Texts,
}

#[derive(Debug)]
struct Page {
    path: String,
    title: String,
    entries: Vec<Place>,
}

/// Where an entry is, and which number and text it has.
#[derive(Debug)]
struct Place {
    /// Its address within the page; empty where that is its number.
    anchor: String,
    number: usize,
    text: usize,
}

/// What is found.
pub(super) struct Entry<'e> {
    pub anchor: &'e str,
    pub number: &'e str,
    pub name: &'e str,
    /// The name in other languages.
    pub names: &'e [(String, String)],
    pub unit: &'e str,
    pub words: &'e str,
}

/// Texts, each once, in the order in which they came.
#[derive(Debug, Default)]
struct Texts {
    all: Vec<String>,
    places: HashMap<String, usize>,
}

impl Texts {
    fn place(&mut self, text: &str) -> usize {
        if let Some(place) = self.places.get(text) {
            return *place;
        }
        let place = self.all.len();
        self.all.push(text.to_owned());
        self.places.insert(text.to_owned(), place);
        place
    }
}

impl Index {
    /// Adds a page; entries that follow are on it.
    pub fn page(&mut self, path: &str, title: &str) {
        self.pages.push(Page { path: path.to_owned(), title: title.to_owned(), entries: Vec::new() });
    }

    /// Adds an entry of the last page.
    pub fn entry(&mut self, entry: &Entry<'_>) {
        let names: Vec<String> = entry.names.iter().map(|(_, name)| line(name)).collect();
        let words: String = line(entry.words).chars().take(WORDS).collect();
        let text = [line(entry.name), names.join(" | "), line(entry.unit), words].join("\t");
        let (number, text) = (self.numbers.place(&line(entry.number)), self.texts.place(&text));
        let anchor = if entry.anchor == entry.number { String::new() } else { line(entry.anchor) };
        if let Some(page) = self.pages.last_mut() {
            page.entries.push(Place { anchor, number, text });
        }
    }

    /// Adds all that another index has, whose pages are in a folder.
    pub fn add(&mut self, other: &Index, folder: &str) {
        let numbers: Vec<usize> = other.numbers.all.iter().map(|own| self.numbers.place(own)).collect();
        let texts: Vec<usize> = other.texts.all.iter().map(|own| self.texts.place(own)).collect();
        let place = |place: &Place| Place {
            anchor: place.anchor.clone(),
            number: numbers[place.number],
            text: texts[place.text],
        };
        self.pages.extend(other.pages.iter().map(|page| Page {
            path: format!("{folder}/{}", page.path),
            title: page.title.clone(),
            entries: page.entries.iter().map(place).collect(),
        }));
    }

    /// The script. Texts are JSON strings, so that nothing in them is code.
    pub fn script(&self) -> String {
        let json = |text: &str| serde_json::to_string(text).unwrap_or_default();
        let pages: Vec<String> =
            self.pages.iter().map(|page| format!("[{},{}]", json(&page.path), json(&page.title))).collect();
        let anchors: Vec<&str> =
            self.pages.iter().flat_map(|page| &page.entries).map(|own| own.anchor.as_str()).collect();
        let lists = [&self.numbers.all.join("\n"), &self.texts.all.join("\n"), &anchors.join("\n")];
        let lists = lists.map(|list| json(list)).join(",\n");
        let mut script = format!("lexibusIndex([{}],\n{lists},\n[", pages.join(","));
        for (at, page) in self.pages.iter().enumerate() {
            script.push_str(if at == 0 { "[" } else { ",[" });
            for (at, own) in page.entries.iter().enumerate() {
                let comma = if at == 0 { "" } else { "," };
                let _ = write!(script, "{comma}{},{}", own.number, own.text);
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
        one.page("a.html", "A");
        one.entry(&entry("0x6040", "Control\nword"));
        one.entry(&entry("word", "first"));
        all.page("x.html", "X");
        all.entry(&entry("0x6040", "first"));
        all.add(&one, "folder");
        let expected = r#"lexibusIndex([["x.html","X"],["folder/a.html","A"]],
"0x6040",
"first\t\t\tTakes commands\nControl word\t\t\tTakes commands",
"\n\nword",
[[0,0],[0,1,0,0]]);"#;
        assert_eq!(all.script().trim_end(), expected);
    }
}
