//! Creates the objects of simulated devices.

use lexibus::table::{AccessRights, Bound, Entry, RawInitial};
use lexibus::{DataType, Flags, Object};

/// Returns a variable object without limits that can be read, written and mapped into PDOs.
pub const fn entry(index: u16, data_type: DataType) -> Entry {
    Entry {
        object: Some(Object::new(index, 0)),
        register: None,
        name: "",
        data_type,
        access: AccessRights::ReadWrite,
        flags: Flags::PDO,
        initial: RawInitial::Unknown,
        configured: None,
        low: Bound::Unlimited,
        high: Bound::Unlimited,
        unit: "",
    }
}
