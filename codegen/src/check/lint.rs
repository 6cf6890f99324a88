//! The declaration of a lint: its name, codes, formats, condition and function.

use super::context::{Context, PdoOwner};
use crate::diagnostics::{Code, Diagnostics};
use crate::ir::owner::Owner;
use crate::ir::{Binding, Catalog, Device, Format, Group};

/// A check of the resolved IR.
#[derive(Debug)]
pub struct Lint {
    /// Name of the lint.
    pub name: &'static str,
    /// Codes that the lint reports.
    pub codes: &'static [&'static Code],
    /// Formats for which the lint runs.
    pub formats: &'static [Format],
    /// True if the lint also runs for other formats when the user sets one of its codes to `warn` or `deny`.
    pub on_request: bool,
    /// Condition that a device has to fulfill for the lint to run. The condition does not apply to modules, records and
    /// the catalog.
    pub needs: Option<Need>,
    pub(super) run: Run,
}

/// A condition that a device has to fulfill for a lint to run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Need {
    /// The device has CANopen settings.
    CanOpen,
    /// The device has EtherCAT settings.
    EtherCat,
    /// The device has messages, framing or parameter spaces.
    Messages,
    /// The device has example Modbus frames.
    ModbusExamples,
    /// The device has procedures.
    Procedures,
    /// The device has items with indirect access through a window.
    Windows,
}

impl Need {
    /// Returns whether the device fulfills the condition.
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

/// The function that runs a lint, by the type of its input.
#[derive(Clone, Copy, Debug)]
pub(super) enum Run {
    /// The lint checks a device.
    Device(fn(&Context<'_>, &mut Diagnostics)),
    /// The lint checks the items and types of a device or module.
    Items(fn(Owner<'_>, &mut Diagnostics)),
    /// The lint checks the items and types of a device, module or parameter record.
    ItemsAndRecords(fn(Owner<'_>, &mut Diagnostics)),
    /// The lint checks the PDOs of a device or module.
    Pdos(fn(&PdoOwner<'_>, &mut Diagnostics)),
    /// The lint checks the parameter records of PROFINET submodules, and the vendor-specific blocks of the connect
    /// request.
    Records(fn(&[Group], &mut Diagnostics)),
    /// The lint checks the whole catalog.
    Catalog(fn(&Catalog, &mut Diagnostics)),
}
