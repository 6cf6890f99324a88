//! What the compiler has to say about its input: one [`Diagnostic`] a finding, each with a stable [`Code`].
//!
//! Stages only describe what they found; [`Levels`] decides how severe it is (lenient or strict, `-A`, `-W`, `-D`), and
//! [`render`] turns the result into text for a terminal, JSON lines or SARIF.

mod allowed;
pub mod codes;
mod error_spans;
mod levels;
pub mod render;

use allowed::Allowed;
pub use codes::{Class, Code};
pub(crate) use error_spans::ErrorSpans;
pub use levels::{Level, Levels, UnknownCode};

use std::collections::{BTreeMap, HashMap};
use std::hash::{Hash, Hasher};

use crate::limits::MAX_SAME_DIAGNOSTICS;
use crate::source::{FileId, Span};

/// How bad a finding is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
pub enum Severity {
    /// The input was understood, perhaps after a repair; output is produced.
    Warning,
    /// The input, or a part of it, could not be used; no output is produced.
    Error,
}

impl Severity {
    /// `error` or `warning`.
    pub fn name(self) -> &'static str {
        match self {
            Severity::Warning => "warning",
            Severity::Error => "error",
        }
    }
}

/// One finding.
#[derive(Clone, Debug)]
pub struct Diagnostic {
    /// What kind of finding it is.
    pub code: &'static Code,
    /// Set by [`Diagnostics::push`] from the code and the levels in force.
    pub severity: Severity,
    /// What is wrong, in one sentence.
    pub message: String,
    /// Where; an empty span means the file as a whole.
    pub span: Span,
    /// What the marked text is or how it was read; may be empty.
    pub label: String,
    /// Further places and facts.
    pub notes: Vec<Note>,
    /// What to do about it.
    pub help: Option<String>,
    /// A replacement of the marked text that mends the finding.
    pub fix: Option<String>,
}

/// A second place, or a further fact, of a finding.
#[derive(Clone, Debug)]
pub struct Note {
    /// Where; `None` for a fact without a place.
    pub span: Option<Span>,
    /// The fact.
    pub message: String,
}

impl Code {
    /// A finding of this kind at `span`.
    pub(crate) fn at(&'static self, span: Span, message: impl Into<String>) -> Diagnostic {
        Diagnostic::new(self, span, message)
    }
}

impl Diagnostic {
    /// A finding of kind `code` at `span`.
    pub fn new(code: &'static Code, span: Span, message: impl Into<String>) -> Self {
        Diagnostic {
            code,
            severity: Severity::Error,
            message: message.into(),
            span,
            label: String::new(),
            notes: Vec::new(),
            help: None,
            fix: None,
        }
    }

    /// Sets the label of the marked text.
    pub fn label(mut self, label: impl Into<String>) -> Self {
        self.label = label.into();
        self
    }

    /// Adds a fact.
    pub fn note(mut self, message: impl Into<String>) -> Self {
        self.notes.push(Note { span: None, message: message.into() });
        self
    }

    /// Adds a second place.
    pub fn note_at(mut self, span: Span, message: impl Into<String>) -> Self {
        self.notes.push(Note { span: Some(span), message: message.into() });
        self
    }

    /// Says what to do.
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// Offers a replacement for the marked text.
    pub fn fix(mut self, replacement: impl Into<String>) -> Self {
        self.fix = Some(replacement.into());
        self
    }
}

/// The findings of one compilation.
#[derive(Clone, Debug, Default)]
pub struct Diagnostics {
    list: Vec<Diagnostic>,
    levels: Levels,
    /// Findings that the source itself explains.
    allowed: Allowed,
    /// How many diagnostics of each code and file are in the list.
    kept: HashMap<(FileId, &'static str), usize>,
    /// Those that are only counted.
    beyond: Vec<Beyond>,
    /// Whether the list ends with a diagnostic for each code and file that has any of these.
    is_closed: bool,
}

/// A diagnostic that is only counted.
#[derive(Clone, Debug)]
struct Beyond {
    code: &'static Code,
    span: Span,
    /// The hash of its message.
    message: u64,
}

impl Diagnostics {
    /// An empty list under `levels`.
    pub fn new(levels: Levels) -> Self {
        Diagnostics { levels, ..Diagnostics::default() }
    }

    /// Files a finding; one whose level is `allow` is forgotten. Of one code in one file, [`MAX_SAME_DIAGNOSTICS`] are kept, and
    /// the others counted.
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

    /// Forgets findings of these kinds within these spans, those so far and those to come: the source explains them itself.
    /// Errors stay.
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

    /// Forgets findings from `first` on that are there already: the same of the same place.
    pub(crate) fn forget_repeated(&mut self, first: usize) {
        let mut seen = std::collections::HashSet::new();
        let tail = self.list.split_off(first.min(self.list.len()));
        let is_new =
            |diagnostic: &Diagnostic| seen.insert((diagnostic.code, diagnostic.span, hash(&diagnostic.message)));
        self.list.extend(tail.into_iter().filter(is_new));
        self.beyond.retain(|diagnostic| seen.insert((diagnostic.code, diagnostic.span, diagnostic.message)));
        self.kept.clear();
        for diagnostic in &self.list {
            *self.kept.entry((diagnostic.span.file, diagnostic.code.id)).or_default() += 1;
        }
    }

    /// Returns where all errors so far are.
    pub(crate) fn error_spans(&self) -> ErrorSpans {
        let is_error = |diagnostic: &&Beyond| self.levels.severity(diagnostic.code) == Some(Severity::Error);
        let kept = self
            .list
            .iter()
            .filter(|diagnostic| diagnostic.severity == Severity::Error)
            .map(|diagnostic| diagnostic.span);
        ErrorSpans::new(kept.chain(self.beyond.iter().filter(is_error).map(|diagnostic| diagnostic.span)))
    }

    /// Whether findings of this kind are wanted: lets a stage skip the work of phrasing one that isn't.
    pub fn wants(&self, code: &'static Code) -> bool {
        self.levels.severity(code).is_some()
    }

    /// Whether the user named this kind of finding: for lints that are on by default for one format only.
    pub fn asks_for(&self, code: &'static Code) -> bool {
        self.levels.asks_for(code)
    }

    /// How many diagnostics there are, those that are only counted included.
    #[cfg(feature = "table")]
    pub(crate) fn total(&self) -> usize {
        self.list.len() + self.beyond.len()
    }

    /// All findings, in the order in which they were made.
    pub fn list(&self) -> &[Diagnostic] {
        &self.list
    }

    /// Sorts by place, so that a reader walks through the file from top to bottom. Behind the diagnostics of a file, one for each
    /// code says how many more there were.
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

    /// Whether any finding is an error.
    pub fn has_errors(&self) -> bool {
        self.list.iter().any(|d| d.severity == Severity::Error)
    }

    /// How many findings have this severity, those that are only counted included.
    pub fn count(&self, severity: Severity) -> usize {
        let kept =
            self.list.iter().filter(|diagnostic| diagnostic.severity == severity && !is_closing(diagnostic)).count();
        kept + self.beyond.iter().filter(|diagnostic| self.levels.severity(diagnostic.code) == Some(severity)).count()
    }
}

/// Behind all places of a file.
const END: u32 = u32::MAX;

fn is_closing(diagnostic: &Diagnostic) -> bool {
    diagnostic.span.start == END
}

/// Says how many more diagnostics of a code a file has.
fn closing(file: FileId, code: &'static Code, count: usize) -> Diagnostic {
    let plural = if count == 1 { "diagnostic" } else { "diagnostics" };
    let message = format!("{count} more {plural} of {} in this file", code.id);
    let allow = if code.class == Class::Error { String::new() } else { format!(", or allow {}", code.id) };
    Diagnostic::new(code, Span::new(file, END, END), message)
        .help(format!("correct the first {MAX_SAME_DIAGNOSTICS}{allow}"))
}

fn hash(text: &str) -> u64 {
    let mut hasher = std::collections::hash_map::DefaultHasher::new();
    text.hash(&mut hasher);
    hasher.finish()
}

#[cfg(test)]
mod tests {
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
        assert_eq!(last.message, "3 more diagnostics of EDS003 in this file");
    }

    #[test]
    fn repeated_and_allowed_ones_are_not_counted() {
        let many = MAX_SAME_DIAGNOSTICS as u32 + 3;
        let mut diagnostics = Diagnostics::default();
        for _ in 0..many {
            diagnostics.push(Diagnostic::new(&codes::JUNK_LINE, Span::new(FileId(0), 5, 6), "junk"));
        }
        diagnostics.forget_repeated(0);
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
