//! Words of tables for access rights, directions of PDOs and object codes.

use crate::ir::{Access, Mappable, ObjectCode};

/// The words of `access`: access rights.
pub(super) const ACCESSES: [(&str, Access); 6] = [
    ("ro", Access::ReadOnly),
    ("rw", Access::ReadWrite),
    ("wo", Access::WriteOnly),
    ("const", Access::Constant),
    ("rwr", Access::ReadWriteInput),
    ("rww", Access::ReadWriteOutput),
];

/// The words of `pdo`: directions of PDOs.
pub(super) const DIRECTIONS: [(&str, Mappable); 4] = [
    ("rx", Mappable { rpdo: true, tpdo: false }),
    ("tx", Mappable { rpdo: false, tpdo: true }),
    ("both", Mappable { rpdo: true, tpdo: true }),
    ("no", Mappable { rpdo: false, tpdo: false }),
];

/// The words of `code`: object codes.
pub(super) const OBJECT_CODES: [(&str, ObjectCode); 4] = [
    ("var", ObjectCode::Var),
    ("array", ObjectCode::Array),
    ("record", ObjectCode::Record),
    ("domain", ObjectCode::Domain),
];
