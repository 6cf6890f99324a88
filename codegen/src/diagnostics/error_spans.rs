//! Spans of errors, for checks that skip rows with errors.

use crate::source::Span;

/// Sorted spans of errors.
pub(crate) struct ErrorSpans(Vec<Span>);

impl ErrorSpans {
    /// Creates the list from spans in any order.
    pub(super) fn new(spans: impl Iterator<Item = Span>) -> Self {
        let mut spans: Vec<Span> = spans.collect();
        spans.sort_unstable();
        ErrorSpans(spans)
    }

    /// Returns whether a span contains an error.
    pub(crate) fn any_in(&self, span: Span) -> bool {
        let first = self.0.partition_point(|error| (error.file, error.start) < (span.file, span.start));
        let mut from = self.0.iter().skip(first).take_while(|error| error.file == span.file && error.start <= span.end);
        from.any(|error| error.end <= span.end)
    }
}
