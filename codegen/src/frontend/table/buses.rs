//! Reads sets of buses.

use super::at::At;
use super::tree::Reader;
use crate::ir::{Bus, Buses};

/// Reads a list of bus names. Reports unknown names.
pub(super) fn read(reader: &mut Reader<'_, '_>, list: &[At<String>]) -> Buses {
    let words = Bus::ALL.map(|bus| (bus.name(), bus));
    list.iter().filter_map(|name| reader.word(name, "bus", &words)).collect()
}
