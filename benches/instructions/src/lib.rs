//! Packing, unpacking and accessing values: generated code, and equivalent code that is written by hand.
//!
//! The binary of this crate contains pairs of equivalent functions. `valgrind` counts their instructions, and the test
//! `instructions` of `lexibus` compares the counts. The bench in `benches/packing` compares the same structs with other
//! libraries.

pub mod hand;

/// A slave with process data of every shape (`axis.esi.xml`).
#[rustfmt::skip]
pub mod axis;

/// A servo drive that follows PROFIdrive (`tests/data/drive.gsdml.xml`).
#[rustfmt::skip]
pub mod station;
