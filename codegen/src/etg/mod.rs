//! Names and numbers of ETG.1000.6 and ETG.2000, for readers and writers of descriptions.

pub mod language;
pub mod type_name;
pub mod unit;
