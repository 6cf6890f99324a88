//! Code that uses the generated code, for documentation.

use crate::collections::HashMap;
use crate::ir::{ItemId, ObjectBuses};

/// Rust calls that read and write each item, such as `device.identity().vendor_id().read()?`.
pub type Calls = HashMap<ItemId, Vec<String>>;

/// The calls and PDO names of a device in the generated code, for documentation.
pub struct Usage {
    /// Calls that read and write the items of the device.
    pub calls: Calls,
    /// Names of the PDO structs, by the index of the mapping object and the buses of the PDO.
    pub pdos: HashMap<(u16, Option<ObjectBuses>), String>,
}

/// The calls and default bytes for the records of a PROFINET submodule, for documentation.
#[derive(Clone, Debug, Default)]
pub struct RecordUsage {
    /// Code that reads and writes the items. In this code, the variable `records` is a `RecordAccess`, and `address` is
    /// the address of the submodule.
    pub calls: Calls,
    /// Default bytes of each record, by its position in the submodule. The bytes of a record are empty unless all of them
    /// are known.
    pub default_bytes: HashMap<u32, Vec<u8>>,
}
