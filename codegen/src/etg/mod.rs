//! Names and numbers of ETG.1000.6 and ETG.2000 that reading and writing a description have in common.

pub(crate) mod language;
pub(crate) mod type_name;
pub(crate) mod unit;
