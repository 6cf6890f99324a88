//! Names and numbers of ETG.1000.6 and ETG.2000 that reading and writing a description have in common.

pub mod language;
pub mod type_name;
pub mod unit;
