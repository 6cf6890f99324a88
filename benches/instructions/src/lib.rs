//! Packing, unpacking and accessing values: generated, and beside it as a person would write it.
//!
//! The binary of this crate holds pairs of functions that do the same; `valgrind` counts their instructions, and the test
//! `instructions` of `lexibus` compares the counts. The bench in `benches/packing` measures the same structs beside
//! other libraries.

pub mod hand;

/// A slave with process data of every shape (`axis.esi.xml`).
#[rustfmt::skip]
pub mod axis;

/// A servo drive that follows PROFIdrive (`tests/data/drive.gsdml.xml`).
#[rustfmt::skip]
pub mod station;
