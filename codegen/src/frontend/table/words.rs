//! Words for access rights, PDO directions and object codes in register tables.

use crate::ir::{Access, Mappable, ObjectCode};

/// Words for access rights, in the key `access`.
pub(super) const ACCESSES: [(&str, Access); 6] = [
    ("ro", Access::ReadOnly),
    ("rw", Access::ReadWrite),
    ("wo", Access::WriteOnly),
    ("const", Access::Constant),
    ("rwr", Access::ReadWriteInput),
    ("rww", Access::ReadWriteOutput),
];

/// Words for PDO directions, in the key `pdo`.
pub(super) const DIRECTIONS: [(&str, Mappable); 4] = [
    ("rx", Mappable { rpdo: true, tpdo: false }),
    ("tx", Mappable { rpdo: false, tpdo: true }),
    ("both", Mappable { rpdo: true, tpdo: true }),
    ("no", Mappable { rpdo: false, tpdo: false }),
];

/// Words for object codes, in the key `code`.
pub(super) const OBJECT_CODES: [(&str, ObjectCode); 4] = [
    ("var", ObjectCode::Var),
    ("array", ObjectCode::Array),
    ("record", ObjectCode::Record),
    ("domain", ObjectCode::Domain),
];
