//! Spans of a source in which diagnostics are allowed.

use super::Code;
use crate::collections::HashMap;
use crate::source::{FileId, Span};

/// Spans in which a code is not reported, sorted for each file and code. As the end of each span, the list stores the
/// maximum end of this span and all previous spans.
#[derive(Clone, Debug, Default)]
pub(super) struct Allowed(HashMap<(FileId, &'static str), Vec<(u32, u32)>>);

impl Allowed {
    /// Adds spans. Each call sorts all spans again, so add the spans of all `allow` keys of a table in one call.
    pub fn extend(&mut self, spans: impl IntoIterator<Item = (Span, &'static Code)>) {
        for (span, code) in spans {
            self.0.entry((span.file, code.id)).or_default().push((span.start, span.end));
        }
        for list in self.0.values_mut() {
            list.sort_unstable();
            let mut maximum = 0;
            for (_, end) in list {
                maximum = maximum.max(*end);
                *end = maximum;
            }
        }
    }

    /// Returns whether a diagnostic is within a span in which its code is allowed.
    pub fn contains(&self, span: Span, code: &'static Code) -> bool {
        let Some(list) = self.0.get(&(span.file, code.id)) else { return false };
        let after = list.partition_point(|(start, _)| *start <= span.start);
        after.checked_sub(1).and_then(|at| list.get(at)).is_some_and(|(_, end)| span.end <= *end)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnostics::codes;

    #[test]
    fn codes_are_allowed_within_nested_spans() {
        let span = |start, end| Span::new(FileId(0), start, end);
        let mut allowed = Allowed::default();
        allowed.extend([(span(0, 90), &codes::ONE_LIMIT), (span(10, 20), &codes::ONE_LIMIT)]);
        allowed.extend([(span(95, 99), &codes::ONE_LIMIT), (span(5, 7), &codes::EMPTY_LIMIT)]);
        for (start, end) in [(0, 90), (10, 20), (15, 60), (30, 40), (95, 99)] {
            assert!(allowed.contains(span(start, end), &codes::ONE_LIMIT), "{start}..{end}");
        }
        for (start, end) in [(0, 91), (89, 96), (94, 95), (100, 101)] {
            assert!(!allowed.contains(span(start, end), &codes::ONE_LIMIT), "{start}..{end}");
        }
        assert!(
            allowed.contains(span(5, 6), &codes::EMPTY_LIMIT) && !allowed.contains(span(8, 9), &codes::EMPTY_LIMIT)
        );
        assert!(!allowed.contains(Span::new(FileId(1), 15, 16), &codes::ONE_LIMIT));
    }
}
