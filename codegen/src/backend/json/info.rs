//! The summary of a file: one JSON object.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::compile::Compilation;
use crate::diagnostics::Severity;
use crate::ir::{Device, Direction, Group};

/// What `lexibus info --format json` says of a file.
#[derive(Clone, Debug, Serialize)]
pub struct Info {
    /// Its name.
    pub file: String,
    /// Its format: `eds`, `dcf`, `xdd`; null where it wasn't recognised.
    pub format: Option<&'static str>,
    /// How its bytes were decoded.
    pub encoding: &'static str,
    /// The devices that it describes.
    pub devices: Vec<DeviceInfo>,
    /// Number of errors, by code.
    pub errors: BTreeMap<&'static str, usize>,
    /// Number of warnings, by code.
    pub warnings: BTreeMap<&'static str, usize>,
}

/// One device.
#[derive(Clone, Debug, Serialize)]
pub struct DeviceInfo {
    /// Number of the vendor.
    pub vendor_id: Option<u32>,
    /// Product code.
    pub product_code: Option<u32>,
    /// Revision number.
    pub revision: Option<u32>,
    /// Name of the product.
    pub name: String,
    /// Number of distinct indices that the file declares.
    pub objects: usize,
    /// Number of addressable sub-entries that the file declares, sub-index 0 included.
    pub entries: usize,
    /// RPDOs whose mapping the file describes.
    pub rx_pdos: Vec<PdoInfo>,
    /// TPDOs whose mapping the file describes.
    pub tx_pdos: Vec<PdoInfo>,
}

/// One PDO.
#[derive(Clone, Copy, Debug, Serialize, PartialEq, Eq)]
pub struct PdoInfo {
    /// Index of its mapping object.
    pub index: u16,
    /// Number of entries, dummy entries included.
    pub entries: usize,
    /// Length in bits.
    pub bits: u32,
}

/// Sums up a checked compilation of one file.
pub fn info(compilation: &Compilation) -> Info {
    let source = compilation.sources.first();
    let mut info = Info {
        file: source.map(|source| source.name().to_owned()).unwrap_or_default(),
        format: compilation.format.map(|format| format.name()),
        encoding: source.map_or("utf-8", |source| source.encoding().name()),
        devices: compilation.catalog.iter().flat_map(|catalog| &catalog.devices).map(device).collect(),
        errors: BTreeMap::new(),
        warnings: BTreeMap::new(),
    };
    for diagnostic in compilation.diagnostics.list() {
        let counts = match diagnostic.severity {
            Severity::Error => &mut info.errors,
            Severity::Warning => &mut info.warnings,
        };
        *counts.entry(diagnostic.code.id).or_default() += 1;
    }
    info
}

fn device(device: &Device) -> DeviceInfo {
    // What follows from CompactPDO stands nowhere in the file.
    let declared = || device.groups.iter().filter(|group| group.origin.line > 0 && group.index().is_some());
    DeviceInfo {
        vendor_id: device.identity.vendor_id,
        product_code: device.identity.product_code,
        revision: device.identity.revision_number,
        name: device.name.to_string(),
        objects: declared().count(),
        entries: declared().map(|group: &Group| group.items.len()).sum(),
        rx_pdos: pdos(device, Direction::Receive),
        tx_pdos: pdos(device, Direction::Transmit),
    }
}

fn pdos(device: &Device, direction: Direction) -> Vec<PdoInfo> {
    let own = device.process_data.pdos.iter().filter(|pdo| pdo.direction == direction && !pdo.implicit);
    own.map(|pdo| PdoInfo { index: pdo.mapping_index, entries: pdo.entries.len(), bits: pdo.bits() }).collect()
}
