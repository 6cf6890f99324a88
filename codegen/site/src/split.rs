//! Splits long content into pages. The HTML size of the elements determines the page breaks of all formats, so all formats have the
//! same pages.

use std::ops::Range;

/// Maximum size of the elements on a page in bytes of HTML, without the frame of the page and the links between its elements. A
/// single element can be larger.
pub(super) const SIZE: usize = 200_000;

/// Number and size of the elements on a page.
#[derive(Debug)]
pub(super) struct Fill {
    /// Maximum number of elements.
    most: usize,
    /// Maximum size.
    limit: usize,
    count: usize,
    size: usize,
}

impl Fill {
    /// Creates an empty page for up to `most` elements.
    pub fn new(most: usize) -> Self {
        Fill { most, limit: SIZE, count: 0, size: 0 }
    }

    /// Returns whether `count` more elements with this total size fit on the page. An empty page accepts any elements.
    pub fn fits(&self, count: usize, size: usize) -> bool {
        self.count == 0 || (self.count + count <= self.most && self.size + size <= self.limit)
    }

    pub fn add(&mut self, count: usize, size: usize) {
        self.count += count;
        self.size += size;
    }
}

/// Returns the range of the elements on each page. A page has up to `most` elements, whose total size is at most
/// `limit`, or a single larger element.
pub(super) fn ranges(sizes: impl IntoIterator<Item = usize>, most: usize, limit: usize) -> Vec<Range<usize>> {
    let mut ranges: Vec<Range<usize>> = Vec::new();
    let mut fill = Fill { limit, ..Fill::new(most) };
    for (at, size) in sizes.into_iter().enumerate() {
        match ranges.last_mut().filter(|_| fill.fits(1, size)) {
            Some(range) => range.end = at + 1,
            None => {
                ranges.push(at..at + 1);
                fill = Fill { limit, ..Fill::new(most) };
            }
        }
        fill.add(1, size);
    }
    ranges
}

/// A group of elements under a heading, such as a code table with its rows.
pub(super) trait Section {
    type Element;
    fn elements(&mut self) -> &mut Vec<Self::Element>;
    /// Returns the same group without elements, for a page that continues the group.
    fn continued(&self) -> Self;
    /// Returns the texts that are shown for an element.
    fn texts(element: &Self::Element) -> impl Iterator<Item = &str>;
}

/// Approximate number of bytes of the tags around an element.
const TAGS: usize = 200;

/// Returns the groups on each page. Each page repeats the heading of the group that it continues.
pub(super) fn pages<S: Section>(groups: Vec<S>) -> Vec<Vec<S>> {
    let mut pages: Vec<Vec<S>> = Vec::new();
    let mut fill = Fill::new(usize::MAX);
    for mut group in groups {
        let elements = std::mem::take(group.elements());
        let sizes = elements.iter().map(|element| TAGS + S::texts(element).map(escaped).sum::<usize>());
        let sizes: Vec<usize> = sizes.collect();
        let continued = group.continued();
        let mut next = Some(group);
        for (element, size) in elements.into_iter().zip(sizes) {
            if pages.is_empty() || !fill.fits(1, size) {
                pages.push(Vec::new());
                fill = Fill::new(usize::MAX);
                next = next.or_else(|| Some(continued.continued()));
            }
            fill.add(1, size);
            let Some(page) = pages.last_mut() else { continue };
            page.extend(next.take());
            if let Some(group) = page.last_mut() {
                group.elements().push(element);
            }
        }
    }
    pages
}

/// Returns the length of a text in HTML.
fn escaped(text: &str) -> usize {
    text.len() + 4 * text.bytes().filter(|letter| b"<>&\"'".contains(letter)).count()
}

/// Returns the title of a page at a position: `Codes`, or `Codes (2 of 3)` if there are several pages.
pub(super) fn title(title: &str, at: usize, count: usize) -> String {
    match count {
        1 => title.to_owned(),
        _ => format!("{title} ({} of {count})", at + 1),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    impl Section for (&str, Vec<String>) {
        type Element = String;
        fn elements(&mut self) -> &mut Vec<String> {
            &mut self.1
        }
        fn continued(&self) -> Self {
            (self.0, Vec::new())
        }
        fn texts(element: &String) -> impl Iterator<Item = &str> {
            [element.as_str()].into_iter()
        }
    }

    #[test]
    fn pages_repeat_the_heading_of_a_group() {
        let half = || "x".repeat(SIZE / 2 - TAGS);
        assert!(pages::<(&str, Vec<String>)>(Vec::new()).is_empty());
        let groups = vec![("a", vec![half(), half(), half()]), ("b", vec![half(), "<".repeat(SIZE / 8)])];
        let pages = pages(groups);
        let counts: Vec<Vec<(&str, usize)>> = pages
            .iter()
            .map(|page| page.iter().map(|(title, list)| (*title, list.len())).collect::<Vec<_>>())
            .collect();
        assert_eq!(counts, [vec![("a", 2)], vec![("a", 1), ("b", 1)], vec![("b", 1)]]);
    }

    #[test]
    fn pages_are_limited_by_number_and_size() {
        assert_eq!(ranges([], 2, SIZE), []);
        assert_eq!(ranges([1, 1, 1], 2, SIZE), [0..2, 2..3]);
        assert_eq!(ranges([SIZE / 2, SIZE / 2, 1, SIZE * 2, 1], 100, SIZE), [0..2, 2..3, 3..4, 4..5]);
    }
}
