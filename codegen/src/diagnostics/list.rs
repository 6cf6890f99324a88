//! The diagnostics of a compilation, limited by levels, allowed spans and a maximum number per code and file.

use std::collections::BTreeMap;
use std::hash::{Hash, Hasher};

use super::allowed::Allowed;
use super::diagnostic::closing;
use super::{Class, Code, Diagnostic, ErrorSpans, Levels, Severity};
use crate::collections::{HashMap, HashSet};
use crate::limits::MAX_SAME_DIAGNOSTICS;
use crate::source::{FileId, Span};

/// Diagnostics of one compilation.
#[derive(Clone, Debug, Default)]
pub struct Diagnostics {
    list: Vec<Diagnostic>,
    levels: Levels,
    /// Spans in which a register table or overlay allows a code (key `allow`).
    allowed: Allowed,
    /// Number of diagnostics in the list, by file and code.
    kept: HashMap<(FileId, &'static str), usize>,
    /// Diagnostics beyond the limit for their code and file, which are only counted.
    beyond: Vec<Beyond>,
    /// True if the list already has the closing diagnostics, which state the number of diagnostics in `beyond`.
    is_closed: bool,
}

/// A diagnostic that is only counted, because its file has too many diagnostics with its code.
#[derive(Clone, Debug)]
struct Beyond {
    code: &'static Code,
    span: Span,
    /// Hash of the message. The hash is compared to find repeated diagnostics.
    message: u64,
}

impl Diagnostics {
    /// Creates an empty list with `levels`.
    pub fn new(levels: Levels) -> Self {
        Diagnostics { levels, ..Diagnostics::default() }
    }

    /// Adds a diagnostic, unless its code is allowed. Keeps at most [`MAX_SAME_DIAGNOSTICS`] diagnostics for each code and file,
    /// and only counts further diagnostics.
    // Most checks report nothing, so code that reports is kept apart from the code of the checks.
    #[cold]
    pub fn push(&mut self, mut diagnostic: Diagnostic) {
        if self.allowed.contains(diagnostic.span, diagnostic.code) {
            return;
        }
        if let Some(severity) = self.levels.severity(diagnostic.code) {
            let key = (diagnostic.span.file, diagnostic.code.id);
            let kept = self.kept.entry(key).or_default();
            if *kept == MAX_SAME_DIAGNOSTICS {
                let message = hash(&diagnostic.message);
                self.beyond.push(Beyond { code: diagnostic.code, span: diagnostic.span, message });
                return;
            }
            *kept += 1;
            diagnostic.severity = severity;
            self.list.push(diagnostic);
        }
    }

    /// Removes diagnostics with these codes within these spans, and suppresses later ones. Diagnostics with codes of
    /// [`Class::Error`] are kept.
    pub fn allow(&mut self, spans: impl IntoIterator<Item = (Span, &'static Code)>) {
        self.allowed.extend(spans.into_iter().filter(|(_, code)| code.class != Class::Error));
        let (allowed, kept) = (&self.allowed, &mut self.kept);
        self.list.retain(|diagnostic| {
            let is_allowed = allowed.contains(diagnostic.span, diagnostic.code);
            if let Some(kept) = kept.get_mut(&(diagnostic.span.file, diagnostic.code.id)).filter(|_| is_allowed) {
                *kept -= 1;
            }
            !is_allowed
        });
        self.beyond.retain(|diagnostic| !allowed.contains(diagnostic.span, diagnostic.code));
    }

    /// Removes repeated diagnostics of the files for which `is_meant` returns true. A repeated diagnostic has the same code, span and
    /// message as an earlier one.
    pub(crate) fn forget_repeated(&mut self, is_meant: impl Fn(FileId) -> bool) {
        let mut seen = HashSet::default();
        let mut is_new = |code, span: Span, message| !is_meant(span.file) || seen.insert((code, span, message));
        self.list.retain(|diagnostic| is_new(diagnostic.code, diagnostic.span, hash(&diagnostic.message)));
        self.beyond.retain(|diagnostic| is_new(diagnostic.code, diagnostic.span, diagnostic.message));
        self.kept.clear();
        for diagnostic in &self.list {
            *self.kept.entry((diagnostic.span.file, diagnostic.code.id)).or_default() += 1;
        }
    }

    /// Returns the spans of all errors so far.
    pub(crate) fn error_spans(&self) -> ErrorSpans {
        let is_error = |diagnostic: &&Beyond| self.levels.severity(diagnostic.code) == Some(Severity::Error);
        let kept = self
            .list
            .iter()
            .filter(|diagnostic| diagnostic.severity == Severity::Error)
            .map(|diagnostic| diagnostic.span);
        ErrorSpans::new(kept.chain(self.beyond.iter().filter(is_error).map(|diagnostic| diagnostic.span)))
    }

    /// Returns whether a code is reported. A stage can call this function to skip a check.
    pub fn wants(&self, code: &'static Code) -> bool {
        self.levels.severity(code).is_some()
    }

    /// Returns whether the user set the level `warn` or `deny` for this code. Some checks then report cases that they
    /// ignore by default.
    pub fn asks_for(&self, code: &'static Code) -> bool {
        self.levels.asks_for(code)
    }

    /// Returns the number of diagnostics, including those that are only counted.
    #[cfg(feature = "table")]
    pub(crate) fn total(&self) -> usize {
        self.list.len() + self.beyond.len()
    }

    /// Returns all kept diagnostics, in the order in which they were added, unless [`Diagnostics::sort`] sorted them.
    pub fn list(&self) -> &[Diagnostic] {
        &self.list
    }

    /// Sorts the diagnostics by file and position. If diagnostics of a code were only counted, a closing diagnostic at the end of
    /// the file states their number.
    pub fn sort(&mut self) {
        if !std::mem::replace(&mut self.is_closed, true) {
            let mut counts: BTreeMap<(FileId, &'static str), (&'static Code, usize)> = BTreeMap::new();
            for diagnostic in &self.beyond {
                counts.entry((diagnostic.span.file, diagnostic.code.id)).or_insert((diagnostic.code, 0)).1 += 1;
            }
            for ((file, _), (code, count)) in counts {
                let severity = self.levels.severity(code).unwrap_or(Severity::Warning);
                self.list.push(Diagnostic { severity, ..closing(file, code, count) });
            }
        }
        self.list.sort_by_key(|d| (d.span.file, d.span.start, d.span.end));
    }

    /// Returns whether the list contains an error.
    pub fn has_errors(&self) -> bool {
        self.list.iter().any(|d| d.severity == Severity::Error)
    }

    /// Returns the number of diagnostics with a severity, including those that are only counted.
    pub fn count(&self, severity: Severity) -> usize {
        let kept =
            self.list.iter().filter(|diagnostic| diagnostic.severity == severity && diagnostic.more == 0).count();
        kept + self.beyond.iter().filter(|diagnostic| self.levels.severity(diagnostic.code) == Some(severity)).count()
    }
}

fn hash(text: &str) -> u64 {
    let mut hasher = std::collections::hash_map::DefaultHasher::new();
    text.hash(&mut hasher);
    hasher.finish()
}

#[cfg(test)]
mod tests {
    use super::super::codes;
    use super::*;

    #[test]
    fn one_code_in_one_file_is_bounded_and_counted() {
        let mut diagnostics = Diagnostics::default();
        for at in 0..MAX_SAME_DIAGNOSTICS as u32 + 3 {
            diagnostics.push(Diagnostic::new(&codes::JUNK_LINE, Span::new(FileId(0), at, at + 1), "junk"));
        }
        diagnostics.push(Diagnostic::new(&codes::JUNK_LINE, Span::new(FileId(1), 0, 1), "junk"));
        diagnostics.push(Diagnostic::new(&codes::OCTAL_NUMBER, Span::new(FileId(0), 0, 1), "octal"));
        let total = MAX_SAME_DIAGNOSTICS + 5;
        let (severity, kept) = (diagnostics.list()[0].severity, diagnostics.list().len());
        assert_eq!((kept, diagnostics.count(severity)), (total - 3, total));
        diagnostics.sort();
        diagnostics.sort();
        assert_eq!((diagnostics.list().len(), diagnostics.count(severity)), (total - 2, total));
        let of_first: Vec<_> =
            diagnostics.list().iter().filter(|diagnostic| diagnostic.span.file == FileId(0)).collect();
        let last = of_first.last().expect("a diagnostic");
        assert_eq!(last.message, "this file has 3 more diagnostics of EDS003");
        assert_eq!((last.more, last.occurrences(), of_first[0].occurrences()), (3, 3, 1));
        assert_eq!(last.with_more(1).message, "this file has 1 more diagnostic of EDS003");
    }

    #[test]
    fn repeated_and_allowed_diagnostics_are_not_counted() {
        let many = MAX_SAME_DIAGNOSTICS as u32 + 3;
        let mut diagnostics = Diagnostics::default();
        for _ in 0..many {
            diagnostics.push(Diagnostic::new(&codes::JUNK_LINE, Span::new(FileId(0), 5, 6), "junk"));
        }
        diagnostics.forget_repeated(|_| true);
        assert_eq!((diagnostics.list().len(), diagnostics.total()), (1, 1));
        let mut diagnostics = Diagnostics::default();
        for at in 0..many {
            diagnostics.push(Diagnostic::new(&codes::OCTAL_NUMBER, Span::new(FileId(0), at, at + 1), "octal"));
        }
        diagnostics.allow([(Span::new(FileId(0), 0, many), &codes::OCTAL_NUMBER)]);
        diagnostics.sort();
        assert_eq!((diagnostics.list().len(), diagnostics.total()), (0, 0));
    }
}
