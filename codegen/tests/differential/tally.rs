//! Counts explained and unexplained differences between two readers.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use super::facts::{compare, Difference, Elements};

/// The accepted reasons for differences. These are the identifiers of rows in the table of quirks, and the known limitations of
/// the independent reader, each with an explanation.
#[derive(Clone, Copy)]
pub struct Reasons {
    pub quirks: &'static [&'static str],
    pub peer: &'static [(&'static str, &'static str)],
}

/// Results of comparing all files of a format.
pub struct Tally {
    format: &'static str,
    reasons: Reasons,
    files: usize,
    rejected: BTreeSet<String>,
    facts: usize,
    agreed: usize,
    explained: BTreeMap<&'static str, usize>,
    unexplained: Vec<String>,
}

impl Tally {
    pub fn new(format: &'static str, reasons: Reasons) -> Self {
        let (explained, unexplained) = (BTreeMap::new(), Vec::new());
        Tally { format, reasons, files: 0, rejected: BTreeSet::new(), facts: 0, agreed: 0, explained, unexplained }
    }

    /// Compares the facts of a file from both readers, and counts the differences.
    pub fn file<'a>(
        &mut self,
        name: &str,
        peer: &'a Elements,
        ours: &'a Elements,
        reason: impl Fn(Difference<'a>) -> Option<&'static str>,
    ) {
        self.files += 1;
        let mut differences = 0;
        let facts = compare(peer, ours, |difference| {
            differences += 1;
            self.count(reason(difference), || format!("{name}: {difference}"));
        });
        self.facts += facts;
        self.agreed += facts - differences;
    }

    /// Counts a file that the independent reader rejects, with the reason.
    pub fn rejected(&mut self, name: &str, error: &str, reason: Option<&'static str>) {
        self.rejected.insert(name.to_owned());
        self.count(reason, || format!("{name}: the peer rejects it: {error}"));
    }

    fn count(&mut self, reason: Option<&'static str>, what: impl Fn() -> String) {
        match reason {
            Some(reason) => *self.explained.entry(reason).or_default() += 1,
            None => self.unexplained.push(what()),
        }
    }

    /// Prints the counts. Panics if a difference is unexplained, or if too few facts were compared. Also panics if a reason is
    /// unused or not listed, or if the table of quirks lacks it.
    pub fn finish(self, least_facts: usize) {
        eprintln!(
            "{}: {} files, {} rejected by the peer at least once; {} facts, {} agree; explained: {:?}",
            self.format,
            self.files,
            self.rejected.len(),
            self.facts,
            self.agreed,
            self.explained
        );
        let shown = self.unexplained.iter().take(200).map(String::as_str).collect::<Vec<_>>().join("\n");
        assert!(self.unexplained.is_empty(), "{} differences are unexplained:\n{shown}", self.unexplained.len());
        let peer = self.reasons.peer.iter().map(|(name, _)| *name);
        let known: Vec<&str> = self.reasons.quirks.iter().copied().chain(peer).collect();
        let dead: Vec<&&str> = known.iter().filter(|reason| !self.explained.contains_key(**reason)).collect();
        assert!(dead.is_empty(), "these reasons explain no difference:  {dead:?}");
        let unlisted: Vec<&&str> = self.explained.keys().filter(|reason| !known.contains(reason)).collect();
        assert!(unlisted.is_empty(), "these reasons are not listed:  {unlisted:?}");
        if let Some(table) = table_of_quirks() {
            let unknown: Vec<_> = self.reasons.quirks.iter().filter(|id| !table.contains(**id)).collect();
            assert!(unknown.is_empty(), "these are not rows of the table of quirks:  {unknown:?}");
        }
        assert!(self.facts >= least_facts, "only {} facts were compared", self.facts);
    }
}

/// Returns the identifiers in the table of quirks. The table is outside the repository. If the table is missing, prints a
/// message and returns `None`.
fn table_of_quirks() -> Option<BTreeSet<String>> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/QUIRKS.md");
    let Ok(text) = std::fs::read_to_string(&path) else {
        eprintln!("not checked: there is no table of quirks at {}", path.display());
        return None;
    };
    let ids = text.lines().filter_map(|line| Some(line.strip_prefix("| ")?.split_once(" |")?.0.to_owned()));
    Some(ids.collect())
}
