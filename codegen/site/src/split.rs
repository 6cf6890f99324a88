//! Splits long content into pages. The HTML size of the elements decides in all formats, so all formats have the same pages.

use std::ops::Range;

/// Maximum size of the elements on a page in bytes of HTML. The frame of the page and the links between its elements come on top.
/// A single element can be larger.
const SIZE: usize = 200_000;

/// Number and size of the elements on a page.
#[derive(Debug)]
pub(super) struct Fill {
    /// Maximum number of elements.
    most: usize,
    count: usize,
    size: usize,
}

impl Fill {
    /// Creates an empty page for up to `most` elements.
    pub fn new(most: usize) -> Self {
        Fill { most, count: 0, size: 0 }
    }

    /// Returns whether `count` more elements with this total size fit on the page. All elements fit on an empty page.
    pub fn fits(&self, count: usize, size: usize) -> bool {
        self.count == 0 || (self.count + count <= self.most && self.size + size <= SIZE)
    }

    pub fn add(&mut self, count: usize, size: usize) {
        self.count += count;
        self.size += size;
    }
}

/// Returns the range of the elements on each page. A page has up to `most` elements.
pub(super) fn ranges(sizes: impl IntoIterator<Item = usize>, most: usize) -> Vec<Range<usize>> {
    let mut ranges: Vec<Range<usize>> = Vec::new();
    let mut fill = Fill::new(most);
    for (at, size) in sizes.into_iter().enumerate() {
        match ranges.last_mut().filter(|_| fill.fits(1, size)) {
            Some(range) => range.end = at + 1,
            None => {
                ranges.push(at..at + 1);
                fill = Fill::new(most);
            }
        }
        fill.add(1, size);
    }
    ranges
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pages_are_limited_by_number_and_size() {
        assert_eq!(ranges([], 2), []);
        assert_eq!(ranges([1, 1, 1], 2), [0..2, 2..3]);
        assert_eq!(ranges([SIZE / 2, SIZE / 2, 1, SIZE * 2, 1], 100), [0..2, 2..3, 3..4, 4..5]);
    }
}
