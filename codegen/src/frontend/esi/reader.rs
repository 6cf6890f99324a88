//! State of the ESI reader, and its budget for copies.

use super::budget::{Budget, Cost};
use super::templates::Templates;
use crate::diagnostics::{codes, Code};
use crate::etg::language;
use crate::frontend::xml;
use crate::ir::CompactString;
use crate::source::Span;

pub(super) type Reader<'a, 'd> = xml::Reader<'a, 'd, Esi<'a, 'd>>;

/// Texts in several languages, each with its language identifier (`LcId`) if the file declares one.
pub(super) type Names<'a> = xml::Names<'a, Lcid>;

/// State of the ESI reader in addition to that of the XML reader.
pub(super) struct Esi<'a, 'd> {
    pub budget: &'d mut Budget,
    pub templates: &'d Templates<'a>,
}

impl xml::Format for Esi<'_, '_> {
    const STANDARD: &'static str = "ETG.2000";
    const UNKNOWN: &'static Code = &codes::ESI_UNKNOWN_ELEMENT;
    #[rustfmt::skip]
    const ELEMENTS: &'static [&'static str] = &[
        "Access", "ArrayInfo", "AssignActivate", "Backup", "BaseType", "BitLen", "BitOffs", "BitSize", "BootStrap", "Category",
        "Comment", "CompleteAccess", "ConfigData", "CycleTimeSync0", "CycleTimeSync1", "DataType", "DataTypes", "DefaultData",
        "DefaultSize", "DefaultString", "DefaultValue", "Descriptions", "Device", "Devices", "Dictionary", "DisplayName",
        "Elements", "Entry", "EnumInfo", "Exclude", "Fixed", "Flags", "Group", "GroupType", "Groups", "Index", "InitCmd", "LBound",
        "Mailbox", "Mandatory", "MaxData", "MaxSize", "MaxValue", "MinData", "MinSize", "MinValue", "Module", "ModuleIdent",
        "Modules", "Object", "Objects", "OpMode", "PdoMapping", "Profile", "ProfileNo", "Properties", "Property",
        "ReadRestrictions", "RxPdo", "SafetyMapping", "Setting", "ShiftTimeSync0", "ShiftTimeSync1", "Slot", "Slots",
        "StartAddress", "SubIdx", "SubIndex", "SubItem", "Transition", "TxPdo", "Value", "Vendor", "WriteRestrictions",
    ];
    const KEPT: &'static [(&'static str, &'static str)] = &[
        ("Device", "Crc32"),
        ("Module", "Crc32"),
        ("Sm", "Watchdog"),
        ("Type", "CheckRevisionNo"),
        ("Type", "ModulePdoGroup"),
        ("Type", "SRA_ParameterSupported"),
        ("Type", "TcSmClass"),
    ];
    const VALUE: &'static Code = &codes::ESI_VALUE;
    const ELEMENT_IN_KEY: bool = true;
    const ENGLISH: (&'static str, &'static str) = ("LcId", "1033");
}

/// A Windows language identifier; `None` means English.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Lcid(pub Option<u32>);

impl xml::Language for Lcid {
    fn rank(&self) -> u8 {
        language::rank(self.0)
    }

    fn tag(&self) -> CompactString {
        language::tag(self.0)
    }
}

impl Reader<'_, '_> {
    /// Subtracts `cost` from the budget for copies. Returns false if the budget is exceeded. Only the first excess is
    /// reported.
    pub fn derive(&mut self, cost: Cost, span: Span) -> bool {
        if self.format.budget.take(cost) {
            return true;
        }
        if !std::mem::replace(&mut self.format.budget.exceeded, true) {
            let message = "copied facts would exceed the size limit of the description";
            let label = "further copies and the object entries that need them are left out";
            self.report(&codes::INPUT_TOO_LARGE, span, message, label);
        }
        false
    }
}
