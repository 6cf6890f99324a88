//! The summary of a file, as one JSON object.

use std::collections::BTreeMap;

use serde::Serialize;

use lexibus_codegen::compile::Compilation;
use lexibus_codegen::diagnostics::Severity;
use lexibus_codegen::ir::{
    Catalog, Device, Direction, Format, Group, GroupKind, IoData, Module, ProcessData, Submodule, SubmoduleKind,
    SubmoduleUse,
};
use lexibus_codegen::selection::arguments;
use lexibus_codegen::source::{FileId, Origin};

/// The output of `lexibus info --format json` for a file.
#[derive(Clone, Debug, Serialize)]
pub struct Info {
    /// Name of the file.
    pub file: String,
    /// Format: `eds`, `dcf`, `xdd`, `esi`, `gsdml`, `table`; null if the format was not recognized.
    pub format: Option<&'static str>,
    /// Encoding of the file.
    pub encoding: &'static str,
    /// The devices that the file describes; for GSDML, the device access points.
    pub devices: Vec<DeviceInfo>,
    /// The dictionary that several devices share (EtherCATDict), if the file describes one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub dictionary: Option<DictionaryInfo>,
    /// The device access points, for GSDML.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub daps: Option<Vec<DapInfo>>,
    /// The modules that the file describes, for ESI and GSDML.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub modules: Option<Vec<ModuleInfo>>,
    /// The pluggable submodules, for GSDML.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub submodules: Option<Vec<SubmoduleInfo>>,
    /// Number of errors, by code.
    pub errors: BTreeMap<&'static str, usize>,
    /// Number of warnings, by code.
    pub warnings: BTreeMap<&'static str, usize>,
}

/// The summary of a device.
#[derive(Clone, Debug, Serialize)]
pub struct DeviceInfo {
    /// Vendor ID of the device.
    pub vendor_id: Option<u32>,
    /// Product code; for GSDML, the DeviceID.
    pub product_code: Option<u32>,
    /// Revision number of the device.
    pub revision: Option<u32>,
    /// Name of the product.
    pub name: String,
    /// Order code, or Type of ETG.2000; empty if there is none.
    pub order_code: String,
    /// Argument of `--device` that selects only this device; `None` if no argument does. Not part of the JSON object.
    #[serde(skip)]
    pub argument: Option<String>,
    /// Number of objects that the file and the dictionary file of the device declare.
    pub objects: usize,
    /// Number of entries of these objects, including sub-index 0.
    pub entries: usize,
    /// Number of registers (items of chapters), for register tables.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub registers: Option<usize>,
    /// RPDOs whose mapping the file describes.
    pub rx_pdos: Vec<PdoInfo>,
    /// TPDOs whose mapping the file describes.
    pub tx_pdos: Vec<PdoInfo>,
}

/// The summary of a dictionary without a device.
#[derive(Clone, Copy, Debug, Serialize, PartialEq, Eq)]
pub struct DictionaryInfo {
    /// Number of objects that the file declares.
    pub objects: usize,
    /// Number of entries of these objects, including sub-index 0.
    pub entries: usize,
}

/// The summary of a device access point of PROFINET.
#[derive(Clone, Debug, Serialize)]
pub struct DapInfo {
    /// ID of the device access point.
    pub id: String,
    /// Module ident number of the device access point.
    pub ident: u32,
    /// Virtual submodules of the device access point.
    pub virtual_submodules: Vec<SubmoduleInfo>,
}

/// The summary of a module.
#[derive(Clone, Debug, Serialize)]
pub struct ModuleInfo {
    /// ID of the module (GSDML), or its Type (ETG.2000).
    pub id: String,
    /// Ident number of the module.
    pub ident: u32,
    /// Name of the module. Not part of the JSON object.
    #[serde(skip)]
    pub name: String,
    /// Argument of `--module` that selects only this module; `None` if no argument does. Not part of the JSON object.
    #[serde(skip)]
    pub argument: Option<String>,
    /// The bus-specific facts of the module.
    #[serde(flatten)]
    pub content: ModuleContent,
}

/// The bus-specific facts of a module.
#[derive(Clone, Debug, Serialize)]
#[serde(untagged)]
pub enum ModuleContent {
    /// The facts of a PROFINET module.
    Profinet {
        /// Number of input bytes of the module's virtual submodules, including F message trailers.
        input_bytes: u32,
        /// Number of output bytes of the module's virtual submodules, including F message trailers.
        output_bytes: u32,
        /// Parameter records of the module's virtual submodules.
        records: Vec<RecordInfo>,
        /// Virtual submodules of the module.
        virtual_submodules: Vec<SubmoduleInfo>,
    },
    /// The facts of an EtherCAT module.
    EtherCat {
        /// Number of objects that the file declares for the module.
        objects: usize,
        /// Number of entries of these objects, including sub-index 0.
        entries: usize,
        /// RPDOs of the module.
        rx_pdos: Vec<PdoInfo>,
        /// TPDOs of the module.
        tx_pdos: Vec<PdoInfo>,
    },
}

/// The summary of a PROFINET submodule.
#[derive(Clone, Debug, Serialize)]
pub struct SubmoduleInfo {
    /// ID of the submodule.
    pub id: String,
    /// Ident number of the submodule.
    pub ident: u32,
    /// API number of the submodule.
    pub api: u32,
    /// Number of input bytes, including an F message trailer.
    pub input_bytes: u32,
    /// Number of output bytes, including an F message trailer.
    pub output_bytes: u32,
    /// Parameter records of the submodule.
    pub records: Vec<RecordInfo>,
}

/// The summary of a parameter record.
#[derive(Clone, Copy, Debug, Serialize, PartialEq, Eq)]
pub struct RecordInfo {
    /// Index of the record.
    pub index: u16,
    /// Length of the record in bytes.
    pub length: u32,
    /// Number of parameters in the record.
    pub refs: usize,
}

/// The summary of a PDO.
#[derive(Clone, Copy, Debug, Serialize, PartialEq, Eq)]
pub struct PdoInfo {
    /// Index of the mapping object of the PDO.
    pub index: u16,
    /// Number of entries, including dummy entries.
    pub entries: usize,
    /// Length of the PDO in bits.
    pub bits: u32,
}

/// Returns the summary of a checked compilation of one file.
pub fn info(compilation: &Compilation) -> Info {
    let source = compilation.sources.first();
    let nothing = Catalog::default();
    let catalog = compilation.catalog.as_ref().unwrap_or(&nothing);
    let is_gsdml = compilation.format == Some(Format::Gsdml);
    let is_table = compilation.format == Some(Format::Table);
    let is_modular = is_gsdml || compilation.format == Some(Format::Esi);
    let of_devices = arguments::of_devices(&catalog.devices).into_iter();
    let of_modules = arguments::of_modules(&catalog.modules).into_iter();
    let main_devices = || catalog.devices.iter().filter(|device| is_in_main_file(device.origin));
    let mut info = Info {
        file: source.map(|source| source.name().to_owned()).unwrap_or_default(),
        format: compilation.format.map(|format| format.name()),
        encoding: source.map_or("utf-8", |source| source.encoding().name()),
        devices: catalog
            .devices
            .iter()
            .zip(of_devices)
            .filter(|(device, _)| is_in_main_file(device.origin) && !device.dictionary_only)
            .map(|(described, argument)| device(described, catalog, argument, is_table))
            .collect(),
        dictionary: main_devices().find(|device| device.dictionary_only).map(|device| dictionary(device, catalog)),
        daps: is_gsdml.then(|| catalog.devices.iter().map(|device| dap(device, catalog)).collect()),
        modules: is_modular.then(|| {
            let main_modules = catalog.modules.iter().zip(of_modules).filter(|(one, _)| is_in_main_file(one.origin));
            main_modules.map(|(one, argument)| module(one, catalog, argument, is_gsdml)).collect()
        }),
        submodules: is_gsdml.then(|| {
            let pluggable = |one: &&Submodule| one.kind == SubmoduleKind::Pluggable;
            catalog.submodules.iter().filter(pluggable).map(submodule).collect()
        }),
        errors: BTreeMap::new(),
        warnings: BTreeMap::new(),
    };
    for diagnostic in compilation.diagnostics.list() {
        let counts = match diagnostic.severity {
            Severity::Error => &mut info.errors,
            Severity::Warning => &mut info.warnings,
        };
        *counts.entry(diagnostic.code.id).or_default() += diagnostic.occurrences();
    }
    info
}

/// Returns whether an element is in the main file, and not in a file to which the main file refers.
fn is_in_main_file(origin: Origin) -> bool {
    origin.span.file == FileId(0)
}

/// Returns the objects that the file and the dictionary files of its devices declare. Objects from overlays and
/// profiles are excluded.
fn declared<'g>(groups: &'g [Group], catalog: &'g Catalog) -> impl Iterator<Item = &'g Group> {
    let format = |origin: Origin| catalog.files.get(origin.span.file.0 as usize).map(|file| file.format);
    let is_declared = move |group: &&Group| {
        let is_described = is_in_main_file(group.origin) || format(group.origin) == Some(Format::Esi);
        group.origin.line > 0 && group.index().is_some() && is_described
    };
    groups.iter().filter(is_declared)
}

fn device(device: &Device, catalog: &Catalog, argument: Option<String>, is_table: bool) -> DeviceInfo {
    let DictionaryInfo { objects, entries } = dictionary(device, catalog);
    DeviceInfo {
        vendor_id: device.identity.vendor_id,
        product_code: device.identity.product_code,
        revision: device.identity.revision_number,
        name: device.name.to_string(),
        order_code: device.identity.order_code.to_string(),
        argument,
        objects,
        entries,
        registers: is_table.then(|| registers(device)),
        rx_pdos: pdos(&device.process_data, Direction::Receive),
        tx_pdos: pdos(&device.process_data, Direction::Transmit),
    }
}

/// Returns the number of items in the chapters of a register table.
fn registers(device: &Device) -> usize {
    let chapters = device.groups.iter().filter(|group| matches!(group.kind, GroupKind::Chapter));
    chapters.map(|group| group.items.len()).sum()
}

fn dictionary(device: &Device, catalog: &Catalog) -> DictionaryInfo {
    let groups = || declared(&device.groups, catalog);
    DictionaryInfo { objects: groups().count(), entries: groups().map(|group| group.items.len()).sum() }
}

fn dap(device: &Device, catalog: &Catalog) -> DapInfo {
    DapInfo {
        id: device.id.to_string(),
        ident: device.profinet.as_ref().map_or(0, |profinet| profinet.ident),
        virtual_submodules: virtual_submodules(&device.submodules, catalog),
    }
}

fn module(module: &Module, catalog: &Catalog, argument: Option<String>, is_gsdml: bool) -> ModuleInfo {
    let content = if is_gsdml {
        let virtual_submodules = virtual_submodules(&module.submodules, catalog);
        ModuleContent::Profinet {
            input_bytes: virtual_submodules.iter().map(|one| one.input_bytes).sum(),
            output_bytes: virtual_submodules.iter().map(|one| one.output_bytes).sum(),
            records: virtual_submodules.iter().flat_map(|one| &one.records).copied().collect(),
            virtual_submodules,
        }
    } else {
        ModuleContent::EtherCat {
            objects: declared(&module.groups, catalog).count(),
            entries: declared(&module.groups, catalog).map(|group| group.items.len()).sum(),
            rx_pdos: pdos(&module.process_data, Direction::Receive),
            tx_pdos: pdos(&module.process_data, Direction::Transmit),
        }
    };
    let (id, name) = (module.id.to_string(), module.name.to_string());
    ModuleInfo { id, ident: module.number, name, argument, content }
}

fn virtual_submodules(uses: &[SubmoduleUse], catalog: &Catalog) -> Vec<SubmoduleInfo> {
    let all = uses.iter().filter_map(|submodule_use| catalog.submodules.get(submodule_use.submodule.0 as usize));
    all.filter(|one| one.kind == SubmoduleKind::Virtual).map(submodule).collect()
}

fn submodule(submodule: &Submodule) -> SubmoduleInfo {
    let bytes = |data: &Option<Box<IoData>>| data.as_ref().map_or(0, |data| data.image.length + data.image.overhead);
    SubmoduleInfo {
        id: submodule.id.to_string(),
        ident: submodule.ident,
        api: submodule.api,
        input_bytes: bytes(&submodule.input),
        output_bytes: bytes(&submodule.output),
        records: submodule.records.iter().filter_map(record).collect(),
    }
}

fn record(group: &Group) -> Option<RecordInfo> {
    match &group.kind {
        GroupKind::Record(record) => {
            Some(RecordInfo { index: record.index, length: record.length, refs: group.items.len() })
        }
        _ => None,
    }
}

fn pdos(data: &ProcessData, direction: Direction) -> Vec<PdoInfo> {
    let declared_pdos = data.pdos.iter().filter(|pdo| pdo.direction == direction && !pdo.implicit);
    declared_pdos
        .map(|pdo| PdoInfo { index: pdo.mapping_index, entries: pdo.entries.len(), bits: pdo.bits() })
        .collect()
}
