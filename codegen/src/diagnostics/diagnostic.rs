//! One error or warning.

use super::{Class, Code};
use crate::limits::MAX_SAME_DIAGNOSTICS;
use crate::source::{FileId, Span};

/// The severity of a diagnostic.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
pub enum Severity {
    /// The input was read, possibly after a repair. A warning does not prevent output.
    Warning,
    /// The input, or a part of it, cannot be used. An error prevents output.
    Error,
}

impl Severity {
    /// Returns the name of the severity: `error` or `warning`.
    pub fn name(self) -> &'static str {
        match self {
            Severity::Warning => "warning",
            Severity::Error => "error",
        }
    }
}

/// An error or warning about the input.
#[derive(Clone, Debug)]
pub struct Diagnostic {
    /// Code of the diagnostic.
    pub code: &'static Code,
    /// Severity of the diagnostic. [`Diagnostics::push`](super::Diagnostics::push) sets it from the code and the levels.
    pub severity: Severity,
    /// Message that states the problem, in lower case and without a full stop.
    pub message: String,
    /// Span of the marked text. An empty span means the whole file.
    pub span: Span,
    /// Label of the marked text: what the compiler did or expected. The label may be empty.
    pub label: String,
    /// Notes with further spans and facts.
    pub notes: Vec<Note>,
    /// Instruction for the user, in the imperative.
    pub help: Option<String>,
    /// Replacement for the marked text.
    pub fix: Option<String>,
    /// Number of further diagnostics with this code in this file, which are only counted. The number is 0, except in the closing
    /// diagnostic, which states the number.
    pub more: usize,
}

/// A note of a diagnostic: a further span or fact.
#[derive(Clone, Debug)]
pub struct Note {
    /// Span of the note; `None` for a fact without a span.
    pub span: Option<Span>,
    /// Text of the note.
    pub message: String,
}

impl Code {
    /// Creates a diagnostic with this code at `span`.
    pub(crate) fn at(&'static self, span: Span, message: impl Into<String>) -> Diagnostic {
        Diagnostic::new(self, span, message)
    }
}

impl Diagnostic {
    /// Creates a diagnostic with a code at `span`.
    #[cold]
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
            more: 0,
        }
    }

    /// Sets the label, which is shown at the marked text.
    pub fn label(mut self, label: impl Into<String>) -> Self {
        self.label = label.into();
        self
    }

    /// Adds a note without a span.
    pub fn note(mut self, message: impl Into<String>) -> Self {
        self.notes.push(Note { span: None, message: message.into() });
        self
    }

    /// Adds a note with a span.
    pub fn note_at(mut self, span: Span, message: impl Into<String>) -> Self {
        self.notes.push(Note { span: Some(span), message: message.into() });
        self
    }

    /// Sets the help text.
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// Sets the replacement for the marked text.
    pub fn fix(mut self, replacement: impl Into<String>) -> Self {
        self.fix = Some(replacement.into());
        self
    }

    /// Returns how many diagnostics this one represents: the number of counted diagnostics for a closing diagnostic, and
    /// otherwise 1.
    pub fn occurrences(&self) -> usize {
        self.more.max(1)
    }

    /// Returns a copy of a closing diagnostic with another number of further diagnostics.
    pub fn with_more(&self, more: usize) -> Self {
        Diagnostic { severity: self.severity, ..closing(self.span.file, self.code, more) }
    }
}

/// Start of the span of a closing diagnostic: after all positions in a file.
const END: u32 = u32::MAX;

/// Creates the diagnostic that states how many more diagnostics of a code a file has.
pub(super) fn closing(file: FileId, code: &'static Code, count: usize) -> Diagnostic {
    let plural = if count == 1 { "diagnostic" } else { "diagnostics" };
    let message = format!("this file has {count} more {plural} of {}", code.id);
    let allow = if code.class == Class::Error { String::new() } else { format!(", or allow {}", code.id) };
    let help = format!("correct the causes of the first {MAX_SAME_DIAGNOSTICS} diagnostics{allow}");
    Diagnostic { more: count, ..Diagnostic::new(code, Span::new(file, END, END), message).help(help) }
}
