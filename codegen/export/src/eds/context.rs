//! Options of an export, and data that the writers of all parts of the file use.

use lexibus_codegen::ir::{Binding, Device, Group};

/// The kind of file (CiA 306).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Flavor {
    /// An electronic data sheet. An EDS describes a device type without its configuration.
    #[default]
    Eds,
    /// A device configuration file. A DCF adds the node-ID, the network, configured values, denotations and connected
    /// modules.
    Dcf,
}

/// The notation of REAL32 and REAL64 values. CiA 306 defines no notation for real numbers, and tools support different notations.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Reals {
    /// Decimal numbers, as in the files of vendors and in Python's `canopen` library.
    #[default]
    Decimal,
    /// The IEEE 754 bit pattern in hexadecimal, as in the Lely CANopen tools.
    Pattern,
}

/// The options of an export.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// Kind of the file to write: EDS or DCF.
    pub flavor: Flavor,
    /// Notation of real numbers in the file.
    pub reals: Reals,
}

impl From<Flavor> for Options {
    fn from(flavor: Flavor) -> Self {
        Options { flavor, ..Options::default() }
    }
}

/// Data that the writers of all parts of the file use.
pub(super) struct Context<'a> {
    pub(super) device: &'a Device,
    pub(super) flavor: Flavor,
    pub(super) reals: Reals,
    /// Name of the source file.
    pub(super) file_name: &'a str,
    /// True if the source is a CiA 306 file. The export then keeps the spellings of the source and adds no missing
    /// facts.
    pub(super) is_verbatim: bool,
    /// True if the source describes a CANopen device.
    pub(super) is_canopen: bool,
}

/// Returns whether the device is a CANopen device and this object exists only on EtherCAT.
pub(super) fn is_coe_only(device: &Device, group: &Group) -> bool {
    let is_coe = |binding: &Binding| matches!(binding, Binding::Object { buses, .. } if !buses.canopen);
    let mut items = group.items.iter();
    device.canopen.is_some() && !group.items.is_empty() && items.all(|item| item.bindings.iter().any(is_coe))
}
