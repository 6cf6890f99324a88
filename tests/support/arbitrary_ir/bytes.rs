//! Derives random choices from a sequence of bytes. After the last byte, each choice returns the minimum, and lists get no more
//! elements.

use std::ops::RangeInclusive;

use arbitrary::unstructured::Int;
use arbitrary::{Arbitrary, Unstructured};

/// The bytes that have not been used.
pub struct Bytes<'b>(Unstructured<'b>);

impl<'b> Bytes<'b> {
    pub fn new(bytes: &'b [u8]) -> Self {
        Bytes(Unstructured::new(bytes))
    }

    /// Returns an arbitrary value of a type.
    pub fn any<T: Arbitrary<'b> + Default>(&mut self) -> T {
        self.0.arbitrary().unwrap_or_default()
    }

    /// Returns a number within a range.
    pub fn within<T: Int>(&mut self, range: RangeInclusive<T>) -> T {
        let least = *range.start();
        self.0.int_in_range(range).unwrap_or(least)
    }

    /// Returns true once in `times` calls, on average.
    pub fn one_in(&mut self, times: u8) -> bool {
        self.within(1..=times) == times
    }

    /// Returns an element of a list, which must not be empty.
    pub fn pick<T: Clone>(&mut self, list: &[T]) -> T {
        list[self.within(0..=list.len() - 1)].clone()
    }

    /// Returns a value once in `times` calls, on average.
    pub fn maybe<T>(&mut self, times: u8, make: impl FnOnce(&mut Self) -> T) -> Option<T> {
        self.one_in(times).then(|| make(self))
    }

    /// Returns a list of up to `most` values.
    pub fn list<T>(&mut self, most: usize, mut make: impl FnMut(&mut Self) -> T) -> Vec<T> {
        let count = self.within(0..=most);
        (0..count).map(|_| make(self)).collect()
    }

    /// Returns a list of up to `most` values once in `times` calls, on average. In all other calls, the list is empty.
    pub fn few<T>(&mut self, times: u8, most: usize, make: impl FnMut(&mut Self) -> T) -> Vec<T> {
        if self.one_in(times) {
            self.list(most, make)
        } else {
            Vec::new()
        }
    }
}
