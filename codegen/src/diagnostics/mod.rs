//! What the compiler has to say about its input: one [`Diagnostic`] a finding, each with a stable [`Code`].
//!
//! Stages only describe what they found; [`Levels`] decides how severe it is (lenient or strict, `-A`, `-W`, `-D`), and
//! [`render`] turns the result into text for a terminal, JSON lines or SARIF.

pub mod codes;
mod levels;
pub mod render;

pub use codes::{Class, Code};
pub use levels::{Level, Levels, UnknownCode};

use serde::{Deserialize, Serialize};

use crate::source::Span;

/// How bad a finding is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
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

/// Whether `inner` lies within `outer`.
fn contains(outer: Span, inner: Span) -> bool {
    outer.file == inner.file && outer.start <= inner.start && inner.end <= outer.end
}

/// The findings of one compilation.
#[derive(Clone, Debug, Default)]
pub struct Diagnostics {
    list: Vec<Diagnostic>,
    levels: Levels,
    /// Findings that the source itself explains, by the place that they are in.
    allowed: Vec<(Span, &'static Code)>,
}

impl Diagnostics {
    /// An empty list under `levels`.
    pub fn new(levels: Levels) -> Self {
        Diagnostics { list: Vec::new(), levels, allowed: Vec::new() }
    }

    /// Files a finding; one whose level is `allow` is forgotten.
    pub fn push(&mut self, mut diagnostic: Diagnostic) {
        let is_allowed = |own: &(Span, &'static Code)| contains(own.0, diagnostic.span) && own.1 == diagnostic.code;
        if self.allowed.iter().any(is_allowed) {
            return;
        }
        if let Some(severity) = self.levels.severity(diagnostic.code) {
            diagnostic.severity = severity;
            self.list.push(diagnostic);
        }
    }

    /// Forgets findings of this kind within `span`, those so far and those to come: the source explains them itself.
    /// Errors stay.
    pub fn allow(&mut self, span: Span, code: &'static Code) {
        if code.class != Class::Error {
            self.list.retain(|own| own.code != code || !contains(span, own.span));
            self.allowed.push((span, code));
        }
    }

    /// Forgets findings from `first` on that are there already: the same of the same place.
    pub(crate) fn forget_repeated(&mut self, first: usize) {
        let mut seen = std::collections::HashSet::new();
        let tail = self.list.split_off(first.min(self.list.len()));
        let is_new = |own: &Diagnostic| seen.insert((own.code, own.span, own.message.clone()));
        self.list.extend(tail.into_iter().filter(is_new));
    }

    /// Whether any finding within `span` is an error.
    pub(crate) fn has_error_in(&self, span: Span) -> bool {
        self.list.iter().any(|own| own.severity == Severity::Error && contains(span, own.span))
    }

    /// Whether findings of this kind are wanted: lets a stage skip the work of phrasing one that isn't.
    pub fn wants(&self, code: &'static Code) -> bool {
        self.levels.severity(code).is_some()
    }

    /// Whether the user named this kind of finding: for lints that are on by default for one format only.
    pub fn asks_for(&self, code: &'static Code) -> bool {
        self.levels.asks_for(code)
    }

    /// All findings, in the order in which they were made.
    pub fn list(&self) -> &[Diagnostic] {
        &self.list
    }

    /// Sorts by place, so that a reader walks through the file from top to bottom.
    pub fn sort(&mut self) {
        self.list.sort_by_key(|d| (d.span.file, d.span.start, d.span.end));
    }

    /// Whether any finding is an error.
    pub fn has_errors(&self) -> bool {
        self.list.iter().any(|d| d.severity == Severity::Error)
    }

    /// How many findings have this severity.
    pub fn count(&self, severity: Severity) -> usize {
        self.list.iter().filter(|d| d.severity == severity).count()
    }
}
