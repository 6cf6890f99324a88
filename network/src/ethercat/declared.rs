//! What the section `segment` of a network file declares.

use lexibus_codegen::source::Span;

use crate::declared::{DeclaredParameter, ObjectName};
use crate::syntax::{At, Scalar};

/// An EtherCAT segment as the file declares it.
#[derive(Clone, Debug)]
pub struct DeclaredSegment {
    /// Location of the section.
    pub span: Span,
    /// Cycle time in µs.
    pub cycle: Option<At<u32>>,
    /// SubDevices in the order of their positions.
    pub subdevices: Vec<DeclaredSubDevice>,
}

/// A SubDevice as its section declares it.
#[derive(Clone, Debug)]
pub struct DeclaredSubDevice {
    /// Name of the SubDevice.
    pub name: At<String>,
    /// Path of the device description.
    pub device: Option<At<String>>,
    /// Name, order code or product code of the device, if the description contains several devices.
    pub model: Option<At<String>>,
    /// Paths of overlays.
    pub overlays: Vec<At<String>>,
    /// Expected revision number, instead of that of the description.
    pub revision_number: Option<u32>,
    /// Station alias.
    pub alias: Option<At<u16>>,
    /// Modules in the slots; `None` = the default modules of the description.
    pub modules: Option<At<Vec<DeclaredModule>>>,
    /// Assigned PDOs; `None` = those that the description assigns by default.
    pub pdos: Option<At<Vec<At<ObjectName>>>>,
    /// Name of the mode of the distributed clocks; `None` = the default mode of the description.
    pub clock_mode: Option<At<String>>,
    /// Values of objects, in the order in which they are written.
    pub parameters: Vec<DeclaredParameter>,
}

/// A module in a slot as the file declares it.
#[derive(Clone, Debug)]
pub struct DeclaredModule {
    /// Number of the slot, counted from 0.
    pub slot: At<u16>,
    /// Ident, type or name of the module.
    pub module: At<Scalar>,
    /// Values of objects of the module, in the order in which they are written.
    pub parameters: Vec<DeclaredParameter>,
}
