//! What is true of an element for a person or a program, stated once for every output.
//!
//! | file | subject |
//! |---|---|
//! | `cob_id` | the identifier of a CAN frame and its flags |
//! | `code` | codes as their source prints them |
//! | `pattern` | bits that have to be 0 or 1 |
//! | `pdo` | names of PDOs on CANopen and EtherCAT |
//! | `physical` | physical values next to the raw ones |
//! | `register` | printed and wire addresses on Modbus |

pub(crate) mod cob_id;
pub(crate) mod code;
pub(crate) mod pattern;
pub(crate) mod pdo;
pub(crate) mod physical;
pub(crate) mod register;
