//! Data that the categories share.

use lexibus_codegen::ir::{Device, EtherCatSettings, Pdo};

use super::options::TrackedOptions;
use super::texts::Texts;
use crate::note::Notes;

/// Data that the categories share.
pub(super) struct Context<'a> {
    pub(super) device: &'a Device,
    pub(super) settings: &'a EtherCatSettings,
    pub(super) options: &'a TrackedOptions<'a>,
    pub(super) notes: Notes,
    pub(super) texts: Texts,
}

impl<'a> Context<'a> {
    /// Returns the PDOs that the device has on EtherCAT.
    pub(super) fn pdos(&self) -> impl Iterator<Item = &'a Pdo> {
        self.device.process_data.pdos.iter().filter(|pdo| pdo.buses.is_none_or(|buses| buses.coe))
    }
}
