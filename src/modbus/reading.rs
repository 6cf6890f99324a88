//! State of a block read between the first request and the last response.

use super::block::Block;
use super::limits::Limits;
use super::plan::{bytes, Plan};
use crate::access_error::AccessError;
use crate::bits;
use crate::error::Error;
use crate::register::{Register, RegisterTable};
use crate::value_error::LengthError;

/// Maximum length of a response in bytes, for 125 registers or 2000 bits.
pub(super) const MAX_BYTES: usize = 250;

/// A block read that is in progress.
pub(super) struct Reading<const N: usize> {
    names: [&'static str; N],
    items: [Register; N],
    lengths: [usize; N],
    plan: Plan<N>,
    /// Number of requests that have been answered.
    answered: usize,
    values: [[u8; 8]; N],
}

impl<const N: usize> Reading<N> {
    pub(super) fn new<B: Block<N>, E>(block: &B, limits: &Limits) -> Result<Self, AccessError<E>> {
        let (names, items) = (block.names(), block.registers());
        let lengths = B::LENGTHS.map(|length| length.min(8));
        let plan = Plan::new(items, limits).map_err(|error| {
            // The error of the first item that no request can read.
            let mut each = names.iter().zip(items);
            let found = each.find(|(_, item)| Plan::new([*item], limits).is_err());
            let (name, item) = found.map_or(("", None), |(name, item)| (*name, Some(item.into())));
            AccessError::read(error.into(), (name, item))
        })?;
        Ok(Self { names, items, lengths, plan, answered: 0, values: [[0; 8]; N] })
    }

    /// Adds the items of the current request to an error.
    pub(super) fn failed<E>(&self, error: Error<E>) -> AccessError<E> {
        let mut names = self.names.iter().zip(self.plan.request_of()).filter(|(_, of)| **of == self.answered);
        let name = names.next().map_or("", |(name, _)| *name);
        let address = self.plan.requests().get(self.answered).map(|request| (*request).into());
        AccessError::read(error, (name, address)).with_others(names.count())
    }

    /// Returns the next request and the length of its response in bytes.
    pub(super) fn request(&self) -> Option<(Register, usize)> {
        let request = self.plan.requests().get(self.answered)?;
        let length = match self.only_item() {
            Some(at) => *self.lengths.get(at)?,
            None => bytes(request.table, request.count).min(MAX_BYTES),
        };
        Some((*request, length))
    }

    /// Decodes the response to the current request. `length` is the number of bytes that the client reported.
    pub(super) fn answered(&mut self, answer: &[u8], length: usize) -> Result<(), LengthError> {
        if length != answer.len() {
            return Err(LengthError::new(answer.len(), length));
        }
        match (self.only_item(), self.plan.requests().get(self.answered)) {
            (Some(at), _) => {
                let value = self.values.get_mut(at).into_iter().flatten();
                value.zip(answer).for_each(|(to, from)| *to = *from);
            }
            (None, Some(request)) => {
                let request = *request;
                let items = self.plan.request_of().iter().zip(&self.items).zip(&mut self.values).zip(self.lengths);
                for (((_, item), value), length) in items.filter(|(((of, _), _), _)| **of == self.answered) {
                    take(answer, &request, item, value.get_mut(..length).unwrap_or_default())?;
                }
            }
            (None, None) => {}
        }
        self.answered += 1;
        Ok(())
    }

    /// Returns all values. Call this function after the last response.
    pub(super) fn values<B: Block<N>, E>(&self, block: &B) -> Result<B::Values, AccessError<E>> {
        block.values(&self.values).map_err(|error| self.failed(error.into()))
    }

    /// Returns the index of the item, if the current request reads only one item. A request for one item reads the item
    /// in the same way as a request outside a block.
    fn only_item(&self) -> Option<usize> {
        let mut items = (0..N).zip(self.plan.request_of()).filter(|(_, of)| **of == self.answered).map(|(at, _)| at);
        items.next().filter(|_| items.next().is_none())
    }
}

/// Extracts the value of one item from a response. The value must have the length of `value`.
fn take(answer: &[u8], request: &Register, item: &Register, value: &mut [u8]) -> Result<(), LengthError> {
    let first = usize::from(item.address.saturating_sub(request.address)) * usize::from(item.step());
    let length = match item.table {
        RegisterTable::Coil | RegisterTable::DiscreteInput => {
            let bits: [u8; 8] = bits::get_bits(answer, first, item.count.into());
            value.iter_mut().zip(bits).for_each(|(to, from)| *to = from);
            bytes(item.table, item.count)
        }
        RegisterTable::Holding | RegisterTable::Input => take_words(answer, first + item.skipped(), item, value)?,
    };
    if length == value.len() {
        Ok(())
    } else {
        Err(LengthError::new(value.len(), length))
    }
}

/// Extracts the value that begins with word `first` of a response, and returns its length in bytes.
fn take_words(answer: &[u8], first: usize, item: &Register, value: &mut [u8]) -> Result<usize, LengthError> {
    let mut words = [0; MAX_BYTES / 2];
    for (word, pair) in words.iter_mut().zip(answer.chunks_exact(2)) {
        *word = pair.try_into().map_or(0, u16::from_le_bytes);
    }
    let behind = first + usize::from(item.count);
    let part = words.get(first..behind).ok_or(LengthError::new(2 * behind, answer.len()))?;
    item.decode(part, value)
}
