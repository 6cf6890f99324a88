//! Generated code and equivalent handwritten code for packing, unpacking and accessing values.
//!
//! The binary of this crate contains pairs of equivalent functions. `valgrind` counts their instructions, and the test
//! `instructions` of the crate `lexibus` compares the counts. The benchmark in `benches/packing` compares the functions
//! of the same structs with those of other libraries.

pub mod hand;

/// An EtherCAT slave whose process data contain fields of all kinds (`axis.esi.xml`).
#[rustfmt::skip]
pub mod axis;

/// A servo drive with the PROFIdrive profile (`tests/data/drive.gsdml.xml`).
#[rustfmt::skip]
pub mod station;
