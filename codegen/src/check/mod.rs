//! Lints on the resolved IR. Lints report wrong and suspicious facts, and do not change the IR. Lints judge only what
//! the description and its overlays state: `ir::stated` leaves out the facts of profiles.
//!
//! `list` declares each lint: its name, codes, formats and condition. Each file contains the lints of one subject.
//! Lints that only concern register tables are in `table`.

mod access;
mod aliases;
mod availability;
mod bit_fields;
mod conditions;
mod context;
mod enumerations;
mod identity;
mod lengths;
mod limits;
mod lint;
mod list;
mod mapped_object;
mod mapping_steps;
#[cfg(feature = "messages")]
mod message_examples;
mod modules;
mod named_values;
mod names;
mod objects;
mod pdo_directions;
mod pdo_entries;
mod pdo_mapping;
mod procedures;
mod process_image;
mod records;
mod run;
mod subslots;
#[cfg(feature = "table")]
mod table;
mod titles;

pub use lint::{Lint, Need};
pub use list::LINTS;
pub use run::check;
