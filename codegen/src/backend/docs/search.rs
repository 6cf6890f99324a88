//! The index of the search: a line an entry, in a script that pages load when somebody searches.

use std::fmt::Write;

use super::words::one_line as line;

/// So many letters of a description are found.
const WORDS: usize = 80;

/// An index of entries.
#[derive(Debug, Default)]
pub(super) struct Index {
    /// Pages, each with the title of its device.
    pages: Vec<(String, String)>,
    lines: String,
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

impl Index {
    /// Adds a page; entries that follow are on it.
    pub fn page(&mut self, path: &str, title: &str) {
        self.pages.push((path.to_owned(), title.to_owned()));
    }

    /// Adds an entry of the last page. Fields are separated by tabs.
    pub fn entry(&mut self, entry: &Entry<'_>) {
        let page = self.pages.len().saturating_sub(1);
        let _ = write!(self.lines, "{page}\t{}\t{}\t", line(entry.anchor), line(entry.number));
        self.lines.push_str(&line(entry.name));
        self.lines.push('\t');
        for (at, (_, name)) in entry.names.iter().enumerate() {
            self.lines.push_str(if at == 0 { "" } else { " | " });
            self.lines.push_str(&line(name));
        }
        let words: String = line(entry.words).chars().take(WORDS).collect();
        let _ = writeln!(self.lines, "\t{}\t{words}", line(entry.unit));
    }

    /// Adds all that another index has, whose pages are in a folder.
    pub fn add(&mut self, other: &Index, folder: &str) {
        let first = self.pages.len();
        self.pages.extend(other.pages.iter().map(|(path, title)| (format!("{folder}/{path}"), title.clone())));
        for own in other.lines.lines() {
            let Some((page, rest)) = own.split_once('\t') else { continue };
            let page = first + page.parse::<usize>().unwrap_or(0);
            let _ = writeln!(self.lines, "{page}\t{rest}");
        }
    }

    /// The script. Texts are JSON strings, so that nothing in them is code.
    pub fn script(&self) -> String {
        let json = |text: &str| serde_json::to_string(text).unwrap_or_default();
        let pages: Vec<String> =
            self.pages.iter().map(|(path, title)| format!("[{},{}]", json(path), json(title))).collect();
        format!("lexibusIndex([{}],{});\n", pages.join(","), json(&self.lines))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn entry(name: &str) -> Entry<'_> {
        Entry { anchor: "0x6040", number: "0x6040", name, names: &[], unit: "", words: "Takes\tcommands" }
    }

    #[test]
    fn indices_are_joined() {
        let (mut one, mut all) = (Index::default(), Index::default());
        one.page("a.html", "A");
        one.entry(&entry("Control\nword"));
        all.page("x.html", "X");
        all.entry(&entry("first"));
        all.add(&one, "folder");
        let expected = r#"lexibusIndex([["x.html","X"],["folder/a.html","A"]],"0\t0x6040\t0x6040\tfirst\t\t\tTakes commands\n1\t0x6040\t0x6040\tControl word\t\t\tTakes commands\n");"#;
        assert_eq!(all.script().trim_end(), expected);
    }
}
