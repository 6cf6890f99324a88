//! The links between pages. If there are very many pages, each page links only to a few of them, because the size of
//! the site would otherwise grow quadratically.

use std::collections::HashMap;
use std::ops::Range;

use lexibus_codegen::limits::{MAX_LINKED_PAGES, NEAR_LINKED_PAGES};

/// File names and titles of pages in page order. `many` is the range of the pages whose number can be very large.
#[derive(Debug, Default)]
pub(super) struct Links {
    list: Vec<(String, String)>,
    many: Range<usize>,
    /// Position of each file in the page order.
    positions: HashMap<String, usize>,
}

impl Links {
    pub fn new(list: Vec<(String, String)>, many: Range<usize>) -> Self {
        let positions = list.iter().enumerate().map(|(at, (file, _))| (file.clone(), at)).collect();
        Links { list, many, positions }
    }

    /// Returns the same links with changed file names or titles.
    pub fn moved(&self, change: impl Fn(&(String, String)) -> (String, String)) -> Links {
        Links::new(self.list.iter().map(change).collect(), self.many.clone())
    }

    /// Returns the file names and titles of all pages.
    pub fn all(&self) -> impl Iterator<Item = &(String, String)> {
        self.list.iter()
    }

    pub fn count(&self) -> usize {
        self.list.len()
    }

    /// Returns the file name and title of a page by its position.
    pub fn get(&self, at: usize) -> Option<&(String, String)> {
        self.list.get(at)
    }

    /// Returns the position of a file in the page order.
    pub fn position(&self, file: &str) -> Option<usize> {
        self.positions.get(file).copied()
    }

    /// Returns all pages if `many` contains only a few. Otherwise returns the pages near `file` and the pages outside
    /// `many`.
    pub fn near(&self, file: &str) -> impl Iterator<Item = &(String, String)> {
        let Range { start, end } = self.many;
        let near = if end - start <= MAX_LINKED_PAGES {
            start..end
        } else {
            let at = self.position(file).unwrap_or(start).clamp(start, end - 1);
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
        assert_eq!(of(1000, "a page without links to others"), of(1000, "0"));
        assert_eq!(Links::default().near("").count(), 0);
    }
}
