//! The report of a comparison.

use std::fmt::Write as _;

use serde::Serialize;

use super::finding::{Finding, FindingKind};
use crate::description::Description;

/// The result of a comparison.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Report {
    /// Name of the device in the description.
    pub device: String,
    /// Name of the description file.
    pub file: String,
    /// Findings, sorted by kind.
    pub findings: Vec<Finding>,
    /// Values that differ from the default value. They are not deviations.
    pub changed: Vec<Finding>,
    /// Number of readable parameters that were read, and of write-only parameters whose read was refused as expected.
    pub read: usize,
    /// Number of parameters that were read and are declared as writable. Their write access was not verified, because
    /// nothing is written.
    pub unverified_writes: usize,
}

impl Report {
    pub(super) fn new(description: &Description) -> Self {
        Self {
            device: description.device().name.to_string(),
            file: description.file_name().to_owned(),
            findings: Vec::new(),
            changed: Vec::new(),
            read: 0,
            unverified_writes: 0,
        }
    }

    /// Returns the deviations: the findings except those about unverifiable facts.
    pub fn deviations(&self) -> impl Iterator<Item = &Finding> {
        self.findings.iter().filter(|finding| finding.kind.is_deviation())
    }

    fn count(&self, kind: FindingKind) -> usize {
        self.findings.iter().filter(|finding| finding.kind == kind).count()
    }

    /// Returns the number of parameters that cannot be verified. Findings about the whole device, which have no name,
    /// don't count.
    fn unverifiable_parameters(&self) -> usize {
        let is_parameter = |finding: &&Finding| finding.kind == FindingKind::Unverifiable && !finding.name.is_empty();
        self.findings.iter().filter(is_parameter).count()
    }

    /// Returns the report as text, with one line per finding and a summary. If `shows_changed` is true, the text also
    /// lists the values that differ from their default value.
    #[must_use]
    pub fn text(&self, shows_changed: bool) -> String {
        let mut text = String::new();
        let changed = self.changed.iter().filter(|_| shows_changed);
        for finding in self.findings.iter().chain(changed) {
            let _ = writeln!(text, "{finding}");
        }
        let kinds = FindingKind::ALL.into_iter().filter(|kind| kind.is_deviation());
        let counts: Vec<String> = kinds.map(|kind| format!("{} {kind}", self.count(kind))).collect();
        let deviations = self.deviations().count();
        let _ =
            writeln!(text, "{deviations} deviation{}: {}", if deviations == 1 { "" } else { "s" }, counts.join(", "));
        let _ = writeln!(
            text,
            "{} parameters read; {} values differ from the default value; unverifiable: {} parameters, and the write \
             access of {} parameters",
            self.read,
            self.changed.len(),
            self.unverifiable_parameters(),
            self.unverified_writes
        );
        text
    }

    /// Returns the report as a JSON object.
    #[must_use]
    pub fn json(&self) -> String {
        // The report contains only texts and numbers, which serde_json can always write.
        serde_json::to_string_pretty(self).unwrap_or_default() + "\n"
    }
}
