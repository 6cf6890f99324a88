//! A configuration for tests, and a simulated device that stores the written values.

use std::vec::Vec;

use super::{Configuration, Setting};
use crate::abort::AbortCode;
use crate::bus::{CanOpen, Object};
use crate::client::{AsyncClient, Client};
use crate::error::Error;
use crate::node_id::NodeId;
use crate::pdo::SdoWrite;

pub(super) const NODE: NodeId = match NodeId::new(5) {
    Some(node) => node,
    None => unreachable!(),
};

pub(super) const CONFIGURATION: Configuration = Configuration {
    disable_pdos: &[
        Setting::from_node(SdoWrite::new_u32(0x1400, 1, 0x8000_0200)),
        Setting::from_node_default(SdoWrite::new_u32(0x1800, 1, 0x8000_0180)),
    ],
    communication: &[Setting::fixed_default(SdoWrite::new_u16(0x1017, 0, 1000))],
    parameters: &[
        Setting::fixed(SdoWrite::new_bytes(0x2000, 0, b"long text")),
        Setting::fixed(SdoWrite::new_u8(0x2001, 0, 7)).write_only(),
    ],
    mapping: &[
        Setting::fixed(SdoWrite::new_u8(0x1600, 0, 0)),
        Setting::fixed(SdoWrite::new_u32(0x1600, 1, 0x6040_0010)),
        Setting::fixed(SdoWrite::new_u8(0x1600, 0, 1)),
    ],
    pdo_parameters: &[Setting::fixed(SdoWrite::new_u8(0x1400, 2, 1))],
    enable_pdos: &[Setting::from_node(SdoWrite::new_u32(0x1400, 1, 0x200))],
    ..Configuration::EMPTY
};

/// A device that stores the written values. An access to `refused` is refused, and an access to `failing` causes a bus
/// error.
#[derive(Default)]
pub(super) struct Store {
    pub values: Vec<(Object, Vec<u8>)>,
    pub refused: Option<Object>,
    pub failing: Option<Object>,
}

impl Store {
    fn check(&self, object: Object) -> Result<(), Error<()>> {
        match Some(object) {
            object if object == self.refused => Err(Error::Abort(AbortCode::READ_ONLY)),
            object if object == self.failing => Err(Error::Client(())),
            _ => Ok(()),
        }
    }

    pub(super) fn set(&mut self, object: Object, data: &[u8]) {
        self.values.retain(|(other, _)| *other != object);
        self.values.push((object, data.to_vec()));
    }
}

impl Client for Store {
    type Bus = CanOpen;
    type Error = ();

    fn read(&mut self, object: Object, buffer: &mut [u8]) -> Result<usize, Error<()>> {
        self.check(object)?;
        let (_, value) =
            self.values.iter().find(|(other, _)| *other == object).ok_or(Error::Abort(AbortCode::NO_OBJECT))?;
        buffer.iter_mut().zip(value).for_each(|(to, from)| *to = *from);
        Ok(value.len())
    }

    fn write(&mut self, object: Object, data: &[u8]) -> Result<(), Error<()>> {
        self.check(object)?;
        self.set(object, data);
        Ok(())
    }
}

/// The same device with an asynchronous client.
pub(super) struct AsyncStore(pub Store);

impl AsyncClient for AsyncStore {
    type Bus = CanOpen;
    type Error = ();

    async fn read(&mut self, object: Object, buffer: &mut [u8]) -> Result<usize, Error<()>> {
        self.0.read(object, buffer)
    }

    async fn write(&mut self, object: Object, data: &[u8]) -> Result<(), Error<()>> {
        self.0.write(object, data)
    }
}
