//! Where errors are, for checks that skip what already failed.

use crate::source::Span;

/// The spans of errors, in order.
pub(crate) struct ErrorSpans(Vec<Span>);

impl ErrorSpans {
    /// Sorts the spans.
    pub(super) fn new(spans: impl Iterator<Item = Span>) -> Self {
        let mut spans: Vec<Span> = spans.collect();
        spans.sort_unstable();
        ErrorSpans(spans)
    }

    /// Whether any error lies within a span.
    pub(crate) fn any_in(&self, span: Span) -> bool {
        let first = self.0.partition_point(|error| (error.file, error.start) < (span.file, span.start));
        let mut from = self.0.iter().skip(first).take_while(|error| error.file == span.file && error.start <= span.end);
        from.any(|error| error.end <= span.end)
    }
}
