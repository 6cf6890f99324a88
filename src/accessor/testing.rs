//! A device with one value, for the tests of the accessors.

use core::convert::Infallible;
use std::vec::Vec;

pub(super) use crate::now::now;
use crate::value::Value;
use crate::{AsyncClient, CanOpen, Client, Error, Flags, Initial, Item, Object, OnCanOpen, Range};

/// A device that sends `answer` and stores the bytes that are written. The device reports `claimed` as the length if
/// `claimed` is set.
#[derive(Default)]
pub(super) struct Device {
    pub(super) answer: Vec<u8>,
    pub(super) written: Option<Vec<u8>>,
    pub(super) claimed: Option<usize>,
    /// Number of reads.
    pub(super) reads: u32,
}

impl Device {
    pub(super) fn answering(answer: &[u8]) -> Self {
        Self { answer: answer.to_vec(), ..Self::default() }
    }
}

impl Client for Device {
    type Bus = CanOpen;
    type Error = Infallible;

    fn read(&mut self, _: Object, buffer: &mut [u8]) -> Result<usize, Error<Infallible>> {
        self.reads += 1;
        buffer.iter_mut().zip(&self.answer).for_each(|(to, from)| *to = *from);
        Ok(self.claimed.unwrap_or(self.answer.len()))
    }

    fn write(&mut self, _: Object, data: &[u8]) -> Result<(), Error<Infallible>> {
        self.written = Some(data.to_vec());
        Ok(())
    }
}

impl AsyncClient for Device {
    type Bus = CanOpen;
    type Error = Infallible;

    async fn read(&mut self, address: Object, buffer: &mut [u8]) -> Result<usize, Error<Infallible>> {
        Client::read(self, address, buffer)
    }

    async fn write(&mut self, address: Object, data: &[u8]) -> Result<(), Error<Infallible>> {
        Client::write(self, address, data)
    }
}

pub(super) fn item<V: Value, A>() -> Item<V, A, OnCanOpen> {
    Item::new(OnCanOpen::canopen(0x2000, 1), "Test item", Range::Full, Initial::Unknown, "", Flags::NONE)
}
