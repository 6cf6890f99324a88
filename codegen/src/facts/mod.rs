//! What is true of an element for a person or a program, stated once for every output.
//!
//! | file | subject |
//! |---|---|
//! | `address` | addresses of items on every bus |
//! | `cob_id` | the identifier of a CAN frame and its flags |
//! | `code` | codes as their source prints them |
//! | `device` | what a device is called, and what fits into its slots |
//! | `item` | default, range and unit of an item |
//! | `markdown` | texts within Markdown |
//! | `number` | numbers in hexadecimal notation |
//! | `pattern` | bits that have to be 0 or 1 |
//! | `pdo` | names of PDOs on CANopen and EtherCAT |
//! | `physical` | physical values next to the raw ones |
//! | `referrers` | which elements refer to an item |
//! | `register` | printed and wire addresses on Modbus |
//! | `types` | types of values |
//! | `words` | sentences about elements, for documentation of any kind |

pub mod address;
pub mod cob_id;
pub mod code;
pub mod device;
pub mod item;
pub mod markdown;
pub mod number;
pub mod pattern;
pub mod pdo;
pub mod physical;
pub mod referrers;
pub mod register;
pub mod types;
pub mod words;
