//! The links of a page to other pages. If there are very many pages, each one has links to a few only, because the size
//! of a site would otherwise grow quadratically.

use std::collections::HashMap;
use std::ops::Range;

use lexibus_codegen::limits::{MAX_LINKED_PAGES, NEAR_LINKED_PAGES};

/// Files and titles of pages in their order. `many` is the range of pages that can be very many.
#[derive(Debug, Default)]
pub(super) struct Links {
    list: Vec<(String, String)>,
    many: Range<usize>,
    /// Positions of the files.
    positions: HashMap<String, usize>,
}

impl Links {
    pub fn new(list: Vec<(String, String)>, many: Range<usize>) -> Self {
        let positions = list.iter().enumerate().map(|(at, (file, _))| (file.clone(), at)).collect();
        Links { list, many, positions }
    }

    /// Returns all pages.
    pub fn all(&self) -> impl Iterator<Item = &(String, String)> {
        self.list.iter()
    }

    /// Returns all pages. If they are very many, returns those near `file` and those outside of `many`.
    pub fn near(&self, file: &str) -> impl Iterator<Item = &(String, String)> {
        let Range { start, end } = self.many;
        let near = if end - start <= MAX_LINKED_PAGES {
            start..end
        } else {
            let at = self.positions.get(file).copied().unwrap_or(start).clamp(start, end - 1);
            at.saturating_sub(NEAR_LINKED_PAGES).max(start)..(at + NEAR_LINKED_PAGES + 1).min(end)
        };
        [0..start, near, end..self.list.len()].into_iter().flat_map(|range| &self.list[range])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_many_pages_those_nearby_are_linked() {
        let of = |count: usize, file: &str| {
            let pages = (0..count + 2).map(|at| (at.to_string(), at.to_string())).collect();
            let links = Links::new(pages, 1..count + 1);
            links.near(file).map(|(file, _)| file.parse::<usize>().unwrap()).collect::<Vec<_>>()
        };
        let with_ends = |many: Range<usize>, last| [0].into_iter().chain(many).chain([last]).collect::<Vec<_>>();
        assert_eq!(of(MAX_LINKED_PAGES, "7"), (0..MAX_LINKED_PAGES + 2).collect::<Vec<_>>());
        assert_eq!(of(1000, "500"), with_ends(480..521, 1001));
        assert_eq!(of(1000, "1000"), with_ends(980..1001, 1001));
        assert_eq!(of(1000, "0"), with_ends(1..22, 1001));
        assert_eq!(of(1000, "1001"), of(1000, "1000"));
        assert_eq!(of(1000, "no page of these"), of(1000, "0"));
        assert_eq!(Links::default().near("").count(), 0);
    }
}
