//! Choices made from a string of bytes. Where it is used up, each is the least: no list has an element more.

use std::ops::RangeInclusive;

use arbitrary::unstructured::Int;
use arbitrary::{Arbitrary, Unstructured};

/// What is left of the bytes.
pub struct Bytes<'b>(Unstructured<'b>);

impl<'b> Bytes<'b> {
    pub fn new(bytes: &'b [u8]) -> Self {
        Bytes(Unstructured::new(bytes))
    }

    /// Any value of a type.
    pub fn any<T: Arbitrary<'b> + Default>(&mut self) -> T {
        self.0.arbitrary().unwrap_or_default()
    }

    /// A number within a range.
    pub fn within<T: Int>(&mut self, range: RangeInclusive<T>) -> T {
        let least = *range.start();
        self.0.int_in_range(range).unwrap_or(least)
    }

    /// Once in so many times.
    pub fn one_in(&mut self, times: u8) -> bool {
        self.within(1..=times) == times
    }

    /// One of a list that isn't empty.
    pub fn pick<T: Clone>(&mut self, list: &[T]) -> T {
        list[self.within(0..=list.len() - 1)].clone()
    }

    /// Something once in so many times.
    pub fn maybe<T>(&mut self, times: u8, make: impl FnOnce(&mut Self) -> T) -> Option<T> {
        self.one_in(times).then(|| make(self))
    }

    /// Up to so many of something.
    pub fn list<T>(&mut self, most: usize, mut make: impl FnMut(&mut Self) -> T) -> Vec<T> {
        let count = self.within(0..=most);
        (0..count).map(|_| make(self)).collect()
    }

    /// Up to so many of something, once in so many times.
    pub fn few<T>(&mut self, times: u8, most: usize, make: impl FnMut(&mut Self) -> T) -> Vec<T> {
        if self.one_in(times) {
            self.list(most, make)
        } else {
            Vec::new()
        }
    }
}
