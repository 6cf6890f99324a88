//! Front ends: one folder a format, each turning syntax into IR and nothing else.

pub mod canopen;
pub mod declared_encoding;
pub mod detect;
pub mod eds;
pub mod esi;
pub mod gsdml;
pub mod table;
pub mod xdd;
