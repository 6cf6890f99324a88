//! A lint as the list declares it.

use super::context::{Context, PdoOwner};
use crate::diagnostics::{Code, Diagnostics};
use crate::ir::owner::Owner;
use crate::ir::{Binding, Catalog, Device, Format, Group};

/// A check of the resolved IR.
#[derive(Debug)]
pub struct Lint {
    /// Its name.
    pub name: &'static str,
    /// The codes that it reports.
    pub codes: &'static [&'static Code],
    /// The formats for which it runs.
    pub formats: &'static [Format],
    /// Whether it runs for other formats too, if the user sets a level of one of its codes.
    pub on_request: bool,
    /// What a device must have. Modules and records are not asked.
    pub needs: Option<Need>,
    pub(super) run: Run,
}

/// What a device must have so that a lint has something to check.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Need {
    /// Settings of CANopen.
    CanOpen,
    /// Settings of EtherCAT.
    EtherCat,
    /// Messages, their framing, or numbered parameters.
    Messages,
    /// Examples of Modbus frames.
    ModbusExamples,
    /// Procedures.
    Procedures,
    /// Items behind a window.
    Windows,
}

impl Need {
    /// Whether the device has it.
    pub fn is_met(self, device: &Device) -> bool {
        match self {
            Need::CanOpen => device.canopen.is_some(),
            Need::EtherCat => device.ethercat.is_some(),
            Need::Messages => {
                !device.messages.is_empty() || device.framing.is_some() || !device.parameter_spaces.is_empty()
            }
            Need::ModbusExamples => !device.modbus_examples.is_empty(),
            Need::Procedures => !device.procedures.is_empty(),
            Need::Windows => {
                device.items().flat_map(|item| &item.bindings).any(|binding| matches!(binding, Binding::Indirect(_)))
            }
        }
    }
}

/// The function of a lint, by what it looks at.
#[derive(Clone, Copy, Debug)]
pub(super) enum Run {
    /// A device.
    Device(fn(&Context<'_>, &mut Diagnostics)),
    /// The items and types of a device or a module.
    Items(fn(Owner<'_>, &mut Diagnostics)),
    /// The same, and those of parameter records.
    ItemsAndRecords(fn(Owner<'_>, &mut Diagnostics)),
    /// The PDOs of a device or a module.
    Pdos(fn(&PdoOwner<'_>, &mut Diagnostics)),
    /// Parameter records of PROFINET.
    Records(fn(&[Group], &mut Diagnostics)),
    /// Everything.
    Catalog(fn(&Catalog, &mut Diagnostics)),
}
