//! Where errors are, for checks that skip what already failed.

use crate::source::Span;

/// The places of errors, in order.
pub(crate) struct ErrorPlaces(Vec<Span>);

impl ErrorPlaces {
    /// Sorts the places.
    pub(super) fn new(places: impl Iterator<Item = Span>) -> Self {
        let mut places: Vec<Span> = places.collect();
        places.sort_unstable();
        ErrorPlaces(places)
    }

    /// Whether any error lies within a span.
    pub(crate) fn any_in(&self, span: Span) -> bool {
        let first = self.0.partition_point(|own| (own.file, own.start) < (span.file, span.start));
        let mut from = self.0.iter().skip(first).take_while(|own| own.file == span.file && own.start <= span.end);
        from.any(|own| own.end <= span.end)
    }
}
